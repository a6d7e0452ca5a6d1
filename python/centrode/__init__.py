"""Centrode: two drawings in, a pair of gears that works out.

>>> import centrode
>>> pair = centrode.design("heart", "dove", teeth=48)
>>> pair.verdict
<Verdict.GOOD: 'good'>
>>> pair.driver.outline.shape[1]
2

Lengths are mm, angles of results radians. Keyword arguments are the options of the command line, spelled with underscores,
with its units and defaults (:func:`defaults` lists them): degrees for ``pressure_angle`` and ``orientation``, mm for
lengths, N mm for torques.
"""

from __future__ import annotations

from . import _core
from ._api import Train, check, defaults, design, formats, gallery, mate, motion, shapes, train
from ._check import CheckReport
from ._design import Design, Gear, Motion, Run, Simulation
from ._diagnostics import Diagnostic, Verdict
from .errors import CentrodeError, InputError, NotSound

__version__: str = _core.version()

__all__ = [
    "CentrodeError",
    "CheckReport",
    "Design",
    "Diagnostic",
    "Gear",
    "InputError",
    "Motion",
    "NotSound",
    "Run",
    "Simulation",
    "Train",
    "Verdict",
    "__version__",
    "check",
    "defaults",
    "design",
    "formats",
    "gallery",
    "mate",
    "motion",
    "shapes",
    "train",
]
