"""The verdict on two finished gears of any origin."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ._diagnostics import Diagnostic, Verdict, from_records

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class CheckReport:
    """What was found of a pair. Lengths mm, angles radians. True where the pair meshes.

    Attributes
    ----------
    verdict:
        What the findings add up to; true where the pair meshes.
    diagnostics:
        Why it fails, and what deserves attention. Gears that overlap from the start have the code ``"overlap"`` with the
        figure ``"depth"``; gears that never touch ``"no-contact"`` with ``"gap"``.
    teeth, module, center_distance, ratio, phase:
        What is known or was found of the pair.
    driver_axis, follower_axis:
        Axes in the frames of the files.
    driver_angle, follower_angle:
        The motion, shape ``(N,)``; empty where none was found.
    contact:
        Figures of the contact analysis by name; ``None`` without a motion.
    runs:
        Figures of each rigid-body run by name.
    notes:
        What a reader should know.
    """

    verdict: Verdict
    diagnostics: tuple[Diagnostic, ...]
    teeth: tuple[int, int]
    module: float
    center_distance: float
    ratio: float
    phase: float
    driver_axis: tuple[float, float]
    follower_axis: tuple[float, float]
    driver_angle: Array
    follower_angle: Array
    contact: dict[str, float | None] | None
    runs: tuple[dict[str, Any], ...]
    notes: tuple[str, ...]

    def __bool__(self) -> bool:
        return bool(self.verdict)

    def __str__(self) -> str:
        return "\n".join([str(self.verdict), *(f"  {finding}" for finding in self.diagnostics)])


def report(text: str) -> CheckReport:
    """The report that ``centrode check --json`` prints."""
    record: dict[str, Any] = json.loads(text)
    diagnostics = from_records(record["faults"] + record["warnings"])
    return CheckReport(
        verdict=Verdict.of(diagnostics),
        diagnostics=diagnostics,
        teeth=tuple(record["teeth"]),
        module=record["module"],
        center_distance=record["center_distance"],
        ratio=record["ratio"],
        phase=record["phase"],
        driver_axis=tuple(record["driver_axis"]),
        follower_axis=tuple(record["follower_axis"]),
        driver_angle=np.array(record["driver_angle"][: len(record["follower_angle"])]),
        follower_angle=np.array(record["follower_angle"]),
        contact=record["contact"],
        runs=tuple(record["runs"]),
        notes=tuple(record["notes"]),
    )


def limits_text(limits: Mapping[str, Any]) -> str:
    """Limits as TOML."""
    lines, tables = [], []
    for key, value in limits.items():
        name = json.dumps(key.replace("_", "-"))
        if isinstance(value, Mapping):
            tables.append(f"[{name}]\n{limits_text(value)}")
        else:
            lines.append(f"{name} = {value if isinstance(value, str) else float(value)!r}\n")
    return "".join(lines + tables)
