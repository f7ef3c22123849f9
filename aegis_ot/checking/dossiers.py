"""Checks a protocol and puts its dossier together, for a model to read: in the child as well."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..preflight import Options, Report
from ..preflight.dossier import Dossier
from ..preflight.dossier_making import check_with_dossier
from ..preflight.script import Script
from .rehearser import Rehearser
from .tasks import Check, RulePaths, _database


@dataclass(frozen=True)
class CheckWithDossier:
    """Rehearse a protocol, judge it, and tell what a model should know of it."""

    script: Script
    options: Options
    rules: RulePaths
    timeout_s: float

    @property
    def file_name(self) -> str:
        """The protocol's."""
        return self.script.file_name

    def perform(self) -> tuple[Report, Dossier]:
        """Judge."""
        return check_with_dossier(self.script, _database(self.rules), self.options, self.timeout_s)


def rejudging(
    rehearser: Rehearser, script: Script, rules: RulePaths, timeout_s: float
) -> Callable[[Options], Report]:
    """Judges the same protocol once more with other options, for the model's roles.

    What it returns raises :class:`~aegis_ot.checking.TaskFailed`.
    """

    def again(options: Options) -> Report:
        report: Report = rehearser.perform(Check(script, options, rules, timeout_s))
        return report

    return again
