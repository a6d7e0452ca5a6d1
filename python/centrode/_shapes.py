"""What may be given for a shape, and how it reaches the core."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from .errors import InputError

if TYPE_CHECKING:
    import shapely

#: A path, the name of a built-in shape, an ``(N, 2)`` array of points in mm (y upwards), or a Shapely polygon.
ShapeLike = Union[str, "os.PathLike[str]", npt.ArrayLike, "shapely.Polygon"]


def given(shape: Any, what: str) -> tuple[str | npt.NDArray[np.float64], str]:
    """The shape as the core takes it, and what it is called."""
    if isinstance(shape, (str, os.PathLike)):
        return os.fspath(shape), what
    exterior = getattr(shape, "exterior", None)
    if exterior is not None:
        shape = np.asarray(exterior.coords)[:-1]
    try:
        points = np.ascontiguousarray(shape, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"{what} is a {type(shape).__name__}; give a path, the name of a built-in shape, an N x 2 array or a Shapely polygon",
            what,
        ) from error
    if points.ndim != 2 or points.shape[1] != 2:
        raise InputError(f"{what} is an array of shape {points.shape}; give one point a row: (N, 2)", what)
    if not np.isfinite(points).all():
        raise InputError(f"{what} has points that are not finite; leave them out", what)
    return points, what
