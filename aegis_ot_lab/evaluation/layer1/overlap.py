"""How far the wells and lines that a finding names are those of the label."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from aegis_ot.vocabulary import Finding, WellRef

from .labels import Label


@dataclass
class Overlap:
    """Counts pooled over violations that were reported.

    A finding names both ends, the label often one: so the share of labelled places that were
    reported says more than the share of reported places that are labelled.

    Attributes:
        labelled: Places that the labels name.
        labelled_hit: Of these, how many a finding names.
        reported: Places that findings name.
        reported_hit: Of these, how many the label names.
        violations: Violations whose label names places.
        violations_hit: Of these, how many have a place in common with their findings.
    """

    labelled: int = 0
    labelled_hit: int = 0
    reported: int = 0
    reported_hit: int = 0
    violations: int = 0
    violations_hit: int = 0

    def add(self, labelled: int, labelled_hit: int, reported: int, reported_hit: int) -> None:
        """Add one violation's counts."""
        if not labelled:
            return
        self.labelled += labelled
        self.labelled_hit += labelled_hit
        self.reported += reported
        self.reported_hit += reported_hit
        self.violations += 1
        self.violations_hit += labelled_hit > 0

    def to_json(self) -> dict[str, int]:
        """As plain values."""
        return dict(vars(self))

    def __str__(self) -> str:
        if not self.violations:
            return "no violation was reported whose label names any"
        return (
            f"{self.labelled_hit}/{self.labelled} labelled ones reported, "
            f"{self.reported_hit}/{self.reported} reported ones labelled, "
            f"{self.violations_hit}/{self.violations} violations with one in common"
        )


def add_wells(overlap: Overlap, label: Label, rule: str, findings: Iterable[Finding]) -> None:
    """Compare the wells of a violation with those of the findings that report it."""
    wanted = set(label.wells.get(rule, ()))
    wells = {well for finding in findings for well in finding.wells}
    hit = [well for well in wells if wanted & _names(well)]
    named = set().union(*(_names(well) for well in hit)) if hit else set()
    overlap.add(len(wanted), len(wanted & named), len(wells), len(hit))


def _names(well: WellRef) -> set[str]:
    """All ways in which a label may write a well."""
    return {f"{place}:{well.name}" for place in (well.slot, well.label, well.labware) if place}


def add_lines(overlap: Overlap, label: Label, rule: str, findings: Iterable[Finding]) -> None:
    """Compare the lines of a violation with those of the findings that report it."""
    wanted = set(label.lines.get(rule, ()))
    lines = {line for finding in findings for line in finding.lines}
    common = len(wanted & lines)
    overlap.add(len(wanted), common, len(lines), common)
