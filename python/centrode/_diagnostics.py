"""Findings and the verdict they add up to."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any


class Verdict(str, Enum):
    """What the findings of a pair add up to. True where the pair may be used."""

    GOOD = "good"
    WARNINGS = "warnings"
    UNSOUND = "unsound"

    def __bool__(self) -> bool:
        """Whether the pair meshes, with warnings or without."""
        return self is not Verdict.UNSOUND

    def __str__(self) -> str:
        return {"good": "meshes", "warnings": "meshes with warnings", "unsound": "does not mesh"}[self.value]

    @classmethod
    def of(cls, found: Iterable[Diagnostic]) -> Verdict:
        """The verdict on findings: the gravest of them."""
        severities = {finding.severity for finding in found}
        if "fault" in severities:
            return cls.UNSOUND
        return cls.WARNINGS if "warning" in severities else cls.GOOD


@dataclass(frozen=True)
class Diagnostic:
    """One finding.

    Attributes
    ----------
    code:
        Stable name of the kind of finding, in kebab-case.
    severity:
        ``"fault"``, ``"warning"`` or ``"note"``.
    stage:
        The stage of the design that found it, such as ``"analysed"`` or ``"proven"``.
    text:
        The sentence, with its remedy.
    place:
        Where: ``driver_angle`` (radians), ``gear``, ``tooth`` or ``point`` (mm, in a gear's frame); empty when it has no
        place.
    figures:
        The numbers that the sentence quotes, by name.
    """

    code: str
    severity: str
    stage: str
    text: str
    place: Mapping[str, Any] = field(default_factory=dict)
    figures: Mapping[str, float] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"{self.severity}: {self.text}"


def from_records(records: Iterable[Mapping[str, Any]]) -> tuple[Diagnostic, ...]:
    """The findings of a record's list."""
    return tuple(
        Diagnostic(
            code=record["code"],
            severity=record["severity"],
            stage=record.get("stage", ""),
            text=record.get("sentence", ""),
            place=record.get("place") or {},
            figures=record.get("figures") or {},
        )
        for record in records
    )
