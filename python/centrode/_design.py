"""A finished pair of gears, with its arrays, its findings and its files."""

from __future__ import annotations

import html
import json
import os
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._diagnostics import Diagnostic, Verdict, from_records
from ._progress import Progress, listener
from ._words import words
from .errors import InputError, told

if TYPE_CHECKING:
    import shapely
    import trimesh
    from matplotlib.axes import Axes

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Motion:
    """One whole cycle of the pair, first and last pose included; one way of a pair that swings.

    Attributes
    ----------
    driver_angle:
        Driver angles, radians counter-clockwise, from 0. Shape ``(N,)``.
    follower_angle:
        Follower angles psi, radians clockwise, from 0. Shape ``(N,)``.
    transmission:
        psi', the follower's speed over the driver's, at each pose. Shape ``(N,)``. ``None`` for a swinging pair that was
        read from its record.
    """

    driver_angle: Array
    follower_angle: Array
    transmission: Array | None


class Gear:
    """One gear of a pair, in its own frame: origin on its axis, counter-clockwise positive, mm."""

    def __init__(self, design: Design, side: str) -> None:
        self._design = design
        self._side = side

    def _points(self, what: str) -> Array:
        points = self._design._core.points(self._side, what)
        return np.empty((0, 2)) if points is None else points

    @property
    def side(self) -> str:
        """``"driver"`` or ``"follower"``."""
        return self._side

    @property
    def name(self) -> str:
        """What the gear's drawing or motion is called."""
        return str(self._design.record["names"][0 if self._side == "driver" else 1])

    @property
    def teeth(self) -> int:
        """Number of teeth on a full turn."""
        return int(self._design.record[self._side]["teeth"])

    @cached_property
    def outline(self) -> Array:
        """The toothed outline with clearance, counter-clockwise, no repeated last point. Shape ``(N, 2)``, mm."""
        return self._points("outline")

    @cached_property
    def pitch_curve(self) -> Array:
        """The pitch curve (centrode). Shape ``(M, 2)``, mm."""
        return self._points("pitch_curve")

    @cached_property
    def drawing(self) -> Array:
        """The drawing as placed in this gear, shape ``(P, 2)``, mm; empty for a gear made without one."""
        return self._points("input")

    @cached_property
    def bore(self) -> Array | None:
        """The hole for the axle, shape ``(B, 2)``, mm; ``None`` where there is none."""
        return self._design._core.points(self._side, "bore")

    @property
    def likeness(self) -> float | None:
        """Area of pitch curve and drawing in common over that of both together; ``None`` without a drawing."""
        value = self._design.record.get("resemblance", {}).get(f"{self._side}_iou")
        return None if value is None else float(value)

    @cached_property
    def _edges(self) -> tuple[Array, npt.NDArray[np.str_]]:
        found = self._design._core.edges(self._side)
        if found is None:
            raise InputError("a record does not tell flanks from roots; design the pair here to have its edges")
        return found[0], np.array(found[1])

    @property
    def exact_outline(self) -> Array:
        """The outline as generated, without clearance, counter-clockwise. Shape ``(K, 2)``, mm. Of pairs made here alone."""
        return self._edges[0]

    @property
    def edges(self) -> npt.NDArray[np.str_]:
        """What the edge from each point of :attr:`exact_outline` to the next is: ``"flank"``, ``"tip"`` or ``"root"``.
        Shape ``(K,)``. Of pairs made here alone."""
        return self._edges[1]

    def to_shapely(self) -> shapely.Polygon:
        """The gear as a Shapely polygon, its bore a hole. Needs ``shapely``."""
        import shapely

        return shapely.Polygon(self.outline, [] if self.bore is None else [self.bore])

    def __repr__(self) -> str:
        return f"<centrode.Gear {self._side}: {self.teeth} teeth>"


@dataclass(frozen=True)
class Run:
    """One rigid-body run, step by step. Arrays have shape ``(N,)``; angles radians, torques N mm.

    Attributes
    ----------
    drive:
        ``"constant speed"``, without friction, or ``"motor"``, with it.
    backward:
        Whether the driver turned the other way.
    driver_angle, follower_angle, psi:
        Angles, and psi at the driver's.
    driver_torque, windowed_torque, ideal_torque:
        Torque on the driver at the step, averaged over a part of a tooth, and psi' times the load.
    contacts:
        Pairs of teeth that carry load.
    penetration:
        Deepest overlap, mm.
    work_in, work_out:
        Work put into the driver and taken out by the load, N mm.
    summary:
        The figures of the run by name, as ``design.json`` has them.
    """

    drive: str
    backward: bool
    driver_angle: Array
    follower_angle: Array
    psi: Array
    driver_torque: Array
    windowed_torque: Array
    ideal_torque: Array
    contacts: npt.NDArray[np.uint32]
    penetration: Array
    work_in: Array
    work_out: Array
    summary: dict[str, Any]


@dataclass(frozen=True)
class Simulation:
    """Rigid-body runs and what they show."""

    runs: tuple[Run, ...]
    verdict: Verdict
    diagnostics: tuple[Diagnostic, ...]


class Design:
    """A finished pair of gears. Made by :func:`centrode.design`, :func:`centrode.motion`, :func:`centrode.mate` or
    :meth:`load`; immutable."""

    def __init__(self, core: _core.Design) -> None:
        self._core = core
        self.driver = Gear(self, "driver")
        self.follower = Gear(self, "follower")

    @cached_property
    def record(self) -> dict[str, Any]:
        """The whole record, as ``design.json`` holds it."""
        record: dict[str, Any] = json.loads(self._core.record)
        return record

    @property
    def command(self) -> str | None:
        """The command line that makes the same pair; ``None`` of a pair that was read."""
        return self._core.command

    @property
    def center_distance(self) -> float:
        """Distance of the axes, mm."""
        return float(self.record["center_distance"])

    @property
    def module(self) -> float:
        """Module, mm: length of the pitch curve over pi and its teeth."""
        return float(self.record["module"])

    @property
    def ratio(self) -> float:
        """Turns of the driver for one of the follower."""
        return float(self.record["ratio"])

    @cached_property
    def motion(self) -> Motion:
        """One whole cycle of the motion."""
        return Motion(*self._core.motion())

    @cached_property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """All findings, in the order of the stages."""
        return from_records(self.record["meshing"].get("diagnostics", []))

    @property
    def verdict(self) -> Verdict:
        """What the findings add up to."""
        return Verdict.of(self.diagnostics)

    def simulate(self, *, progress: Progress = None, threads: int | None = None, **options: Any) -> Simulation:
        """Runs the pair again as rigid bodies.

        Parameters
        ----------
        options:
            Those of ``centrode simulate``: ``load`` (N mm), ``rpm``, ``friction``, ``both``, ``cycles``, ``material``,
            ``density`` (kg/m^3), ``motor_torque`` (N mm).
        progress, threads:
            As :func:`centrode.design` has them.

        Raises
        ------
        InputError
            For options out of their range, and for a pair that swings.
        """
        with told(), listener(progress) as call:
            runs, _, found = self._core.simulate(words("simulate", options), call, threads)
        made = tuple(Run(summary=json.loads(run.pop("record")), **run) for run in runs)
        diagnostics = from_records(json.loads(found))
        return Simulation(made, Verdict.of(diagnostics), diagnostics)

    def export(self, folder: str | os.PathLike[str], formats: str | Iterable[str] | None = None, **options: Any) -> list[Path]:
        """Writes files into a folder, all or none, and returns their paths: the same bytes as the command line writes.

        Parameters
        ----------
        folder:
            Where; made if it is not there.
        formats:
            Names of formats (:func:`centrode.formats`); all that are written unasked when left out. ``design.json`` is
            always written.
        options:
            How they are written, as ``centrode export`` has it: ``kerf``, ``dxf_r12`` and so on.
        """
        named = [formats] if isinstance(formats, str) else formats
        with told():
            how = words("export", options)
            if named is not None:
                how += words("export", {"export": list(named)})
            return [Path(path) for path in self._core.export(os.fspath(folder), how)]

    def files(self, format: str, **options: Any) -> dict[str, bytes]:
        """The files of one format by name, as :meth:`export` writes them."""
        known = {name: names for name, _, names in _core.formats()}
        with tempfile.TemporaryDirectory() as folder:
            written = self.export(folder, format, **options)
            wanted = [path for path in written if path.name in known.get(format, [path.name])]
            return {path.name: path.read_bytes() for path in wanted}

    def to_bytes(self, format: str, **options: Any) -> bytes:
        """The one file of a format that writes a single file for a pair, such as ``"step"``, ``"glb"`` or ``"mjcf"``."""
        files = self.files(format, **options)
        if len(files) != 1:
            names = ", ".join(files)
            raise InputError(f"{format} writes {len(files)} files ({names}); take them from files({format!r})", "format")
        return next(iter(files.values()))

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Writes ``design.json``: to ``path``, or into it where it is a folder. :meth:`load` reads it back."""
        target = Path(path)
        if target.is_dir():
            target = target / "design.json"
        target.write_text(self._core.record + "\n", encoding="utf-8")
        return target

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Design:
        """Reads a ``design.json``, or the folder that holds one."""
        with told():
            return cls(_core.load(os.fspath(path)))

    def to_trimesh(self) -> trimesh.Scene:
        """The printed parts as a ``trimesh.Scene``, each at its place. Needs ``trimesh``."""
        import io

        import trimesh

        return trimesh.load_scene(io.BytesIO(self.to_bytes("glb")), file_type="glb")

    def to_mjcf(self) -> str:
        """The pair as a MuJoCo scene (XML), for ``mujoco.MjModel.from_xml_string``."""
        return self.to_bytes("mjcf").decode("utf-8")

    def to_shapely(self) -> tuple[shapely.Polygon, shapely.Polygon]:
        """Driver and follower as Shapely polygons, each in its own frame. Needs ``shapely``."""
        return self.driver.to_shapely(), self.follower.to_shapely()

    def posed(self, driver_angle: float) -> tuple[Array, Array]:
        """Both outlines in the world at a driver angle (radians): driver's axis at (0, 0), follower's at (L, 0), mm."""
        motion = self.motion
        cycle = motion.driver_angle[-1]
        turns = np.floor(driver_angle / cycle)
        psi = np.interp(driver_angle - turns * cycle, motion.driver_angle, motion.follower_angle)
        psi += turns * motion.follower_angle[-1]
        follower = _turned(self.follower.outline, -float(psi)) + np.array([self.center_distance, 0.0])
        return _turned(self.driver.outline, driver_angle), follower

    def plot(self, ax: Axes | None = None, driver_angle: float = 0.0) -> Axes:
        """Draws the pair into matplotlib axes (new ones when left out) and returns them. Needs ``matplotlib``."""
        import matplotlib.pyplot as plt

        if ax is None:
            _, ax = plt.subplots()
        for outline, color in zip(self.posed(driver_angle), ("tab:blue", "tab:orange"), strict=True):
            ax.fill(outline[:, 0], outline[:, 1], facecolor=color, edgecolor="black", linewidth=0.5, alpha=0.7)
        ax.plot([0.0, self.center_distance], [0.0, 0.0], "k+", markersize=8)
        ax.set_aspect("equal")
        ax.set_xlabel("mm")
        ax.set_ylabel("mm")
        return ax

    def _repr_html_(self) -> str:
        """The turning pair, for a notebook; a picture of a pair that was read."""
        page = self._core.page()
        if page is None:
            return next(iter(self.files("svg").values())).decode("utf-8")
        page = html.escape(page, quote=True)
        return f'<iframe srcdoc="{page}" width="100%" height="640" style="border:0"></iframe>'

    def __repr__(self) -> str:
        return (
            f"<centrode.Design {self.driver.teeth}:{self.follower.teeth} teeth, "
            f"module {self.module:.3f} mm, {self.center_distance:.2f} mm apart, {self.verdict}>"
        )


def _turned(points: Array, angle: float) -> Array:
    cos, sin = np.cos(angle), np.sin(angle)
    turned: Array = points @ np.array([[cos, sin], [-sin, cos]])
    return turned
