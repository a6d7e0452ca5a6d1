"""What can go wrong, as a small hierarchy.

``CentrodeError`` is the base of all. ``InputError`` is input that cannot be read or an option out of its range: the
message names the place and the remedy. ``NotSound`` carries a pair that was made but must not be trusted.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from . import _core

if TYPE_CHECKING:
    from ._design import Design
    from ._diagnostics import Diagnostic


class CentrodeError(Exception):
    """Base of every error that this package raises of its own."""


class InputError(CentrodeError, ValueError):
    """A drawing, a table or an option that cannot be used; the message says which, where, and what to do.

    Attributes
    ----------
    option:
        The keyword argument to blame, where it is known.
    """

    def __init__(self, message: str, option: str | None = None) -> None:
        super().__init__(message)
        self.option = option


class NotSound(CentrodeError):
    """A pair was made, and its own analysis or its runs found that it must not be trusted.

    Attributes
    ----------
    design:
        The pair, for a look at it; ``None`` for a train.
    diagnostics:
        Its findings; those of severity ``"fault"`` are why.
    """

    def __init__(self, message: str, design: Design | None = None) -> None:
        super().__init__(message)
        self.design = design
        self.diagnostics: tuple[Diagnostic, ...] = () if design is None else design.diagnostics


@contextmanager
def told() -> Iterator[None]:
    """Turns what the core refuses into :class:`InputError`."""
    try:
        yield
    except _core.Refused as refused:
        option, text = refused.args
        name = None if option is None else option.replace("-", "_")
        raise InputError(text if name is None else f"{name}: {text}", name) from None
