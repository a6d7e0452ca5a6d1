"""The functions of the package."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy.typing as npt

from . import _core
from ._check import CheckReport, limits_text, report
from ._design import Design
from ._process import carried_out
from ._progress import Progress, listener
from ._shapes import ShapeLike, given
from ._words import facts, words
from .errors import InputError, NotSound, told


def _made(
    command: str,
    shapes: list[tuple[Any, str]],
    options: Mapping[str, Any],
    progress: Progress,
    threads: int | None,
    force: bool,
) -> Design:
    line = words(command, options)
    with told(), listener(progress) as call:
        made = Design(_core.make(command, shapes, line, call, threads))
    if not made.verdict and not force:
        faults = "; ".join(d.text for d in made.diagnostics if d.severity == "fault")
        raise NotSound(f"the pair is not sound: {faults}", made)
    return made


def design(
    driver: ShapeLike,
    follower: ShapeLike,
    *,
    progress: Progress = None,
    threads: int | None = None,
    force: bool = False,
    **options: Any,
) -> Design:
    """Makes a pair of gears from two shapes.

    Parameters
    ----------
    driver, follower:
        A path, the name of a built-in shape (:func:`shapes`), an ``(N, 2)`` array of points (y upwards), or a Shapely
        polygon, of which the exterior is taken.
    progress:
        A function that is called with the stage's name and the share of it that is done; ``True`` for a bar (with
        ``tqdm``). What it raises stops the work.
    threads:
        Threads to work with; one a processor when left out.
    force:
        Return a pair that is not sound instead of raising :class:`NotSound`.
    options:
        The options of ``centrode design``, spelled with underscores, with its units and defaults (:func:`defaults`):
        ``ratio``, ``teeth``, ``center_distance`` (mm), ``pressure_angle`` (degrees), ``driver_axis`` ((x, y)),
        ``no_simulate`` and so on.

    Raises
    ------
    InputError
        For shapes and options that cannot be used.
    NotSound
        Where no sound pair was found; it carries the pair and its diagnostics.
    KeyboardInterrupt
        Soon after Ctrl-C: the work looks for it 40 times a second.
    """
    return _made("design", [given(driver, "driver"), given(follower, "follower")], options, progress, threads, force)


def mate(
    shape: ShapeLike, *, progress: Progress = None, threads: int | None = None, force: bool = False, **options: Any
) -> Design:
    """Makes a gear of one shape, and the gear that runs with it. Parameters and errors as :func:`design`; the options are
    those of ``centrode mate``."""
    return _made("mate", [given(shape, "shape")], options, progress, threads, force)


def motion(
    law: str | None = None,
    *,
    progress: Progress = None,
    threads: int | None = None,
    force: bool = False,
    **options: Any,
) -> Design:
    """Makes a pair that moves as a formula says. Errors as :func:`design`.

    Parameters
    ----------
    law:
        psi' as a formula of phi, such as ``"1 + 0.3*cos(2*phi)"``; left out with ``preset`` or ``centrode``.
    options:
        Those of ``centrode motion``, such as ``preset="ellipse:0.3"``, ``ratio``, ``psi=True``.
    """
    shapes: list[tuple[Any, str]] = [] if law is None else [(str(law), "law")]
    return _made("motion", shapes, options, progress, threads, force)


def check(
    driver: ShapeLike,
    follower: ShapeLike,
    *,
    motion: str | os.PathLike[str] | tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    limits: str | os.PathLike[str] | Mapping[str, Any] | None = None,
    progress: Progress = None,
    threads: int | None = None,
    **options: Any,
) -> CheckReport:
    """Judges two finished gears, whoever made them. A pair that does not mesh is no error: the report says so.

    Parameters
    ----------
    driver, follower:
        A file, an ``(N, 2)`` array of points in mm (the axis at the origin unless ``driver_axis`` says otherwise), or a
        Shapely polygon.
    motion:
        A file of two columns, or driver and follower angles in radians, shape ``(N,)`` each.
    limits:
        Where a pair fails: a TOML file, or a mapping such as ``{"overlap": 0.02}``; ``docs/python.md`` lists them.
    options:
        Those of ``centrode check``: ``center_distance`` (mm), ``ratio``, ``teeth`` ((n, m)), ``no_simulate`` and so on.

    Raises
    ------
    InputError
        For files and options that cannot be used.
    """
    table, angles = None, None
    if isinstance(limits, Mapping):
        table = limits_text(limits)
    elif limits is not None:
        options["limits"] = limits
    if isinstance(motion, (str, os.PathLike)):
        options["motion"] = motion
    elif motion is not None:
        import numpy as np

        first, second = (np.ascontiguousarray(angle, dtype=np.float64) for angle in motion)
        if first.ndim != 1 or first.shape != second.shape:
            raise InputError("motion: give two lists of as many angles, driver and follower", "motion")
        angles = (first, second)
    line = words("check", options)
    with told(), listener(progress) as call:
        gears = (given(driver, "driver"), given(follower, "follower"))
        return report(_core.check(gears, line, table, angles, call, threads))


@dataclass(frozen=True)
class Train:
    """A train of gears that was written.

    Attributes
    ----------
    folder:
        Where its files are.
    record:
        ``train.json``: gears with their axes, outlines and angles (mm, radians), meshes, and what the runs showed.
    """

    folder: Path
    record: dict[str, Any]

    @property
    def sound(self) -> bool:
        """Whether every mesh runs."""
        return bool(self.record["meshing"]["sound"])


def train(plan: Design | str | os.PathLike[str], output: str | os.PathLike[str], **options: Any) -> Train:
    """Puts many gears on their axles and writes their files.

    Runs as a process of its own.

    Parameters
    ----------
    plan:
        A pair to repeat, the folder of one, or a train's TOML file.
    output:
        Folder for the files.
    options:
        Those of ``centrode train``: ``repeat``, ``gears``, ``layout``, ``bend`` (degrees), ``export`` and so on.

    Raises
    ------
    InputError, NotSound
    """
    with tempfile.TemporaryDirectory() as folder:
        source = os.fspath(plan.save(folder)) if isinstance(plan, Design) else os.fspath(plan)
        carried_out(["train", source, f"--output={os.fspath(output)}", "--quiet", *words("train", options)])
    record: dict[str, Any] = json.loads((Path(output) / "train.json").read_text(encoding="utf-8"))
    return Train(Path(output), record)


def gallery(
    shapes: Iterable[str | os.PathLike[str]], output: str | os.PathLike[str], **options: Any
) -> list[dict[str, Any]]:
    """Makes gears of many pairs of shapes and a page on which all turn; returns the rows of its table.

    Runs as a process of its own. Options are those of ``centrode gallery``.

    Raises
    ------
    InputError
    """
    names = [os.fspath(shape) for shape in shapes]
    line = ["gallery", *names, f"--output={os.fspath(output)}", "--quiet", *words("gallery", options)]
    try:
        carried_out(line)
    except NotSound:
        # Some pairs fail; their rows say which.
        if not (Path(output) / "gallery.json").is_file():
            raise
    text = (Path(output) / "gallery.json").read_text(encoding="utf-8")
    rows: list[dict[str, Any]] = json.loads(text)
    return rows


def shapes() -> list[str]:
    """Names of the built-in shapes."""
    return _core.shapes()


def formats() -> list[str]:
    """Names of the formats that a pair is written in."""
    return [name for name, _, _ in _core.formats()]


def defaults(command: str = "design") -> dict[str, str | None]:
    """The keyword arguments of a command with their defaults as the command line spells them; ``None`` where the value is
    chosen, ``"False"`` for a switch."""
    return {
        name.replace("-", "_"): fact["default"] if fact["takes_value"] else "False"
        for name, fact in facts(command).items()
    }
