"""A case for checks: a trace built by hand, with the roles that a test gives its wells."""

from __future__ import annotations

from collections.abc import Mapping

from aegis_ot.preflight import load_rules
from aegis_ot.preflight.checks import Doubt, RuleContext, Violation, make_check
from aegis_ot.preflight.evidence import Evidence, Kind
from aegis_ot.preflight.roles import Roles
from aegis_ot.preflight.roles.roles import Assignment
from aegis_ot.preflight.trace import Trace
from aegis_ot.vocabulary import WellRef

DATABASE = load_rules()


def case_of(
    trace: Trace,
    family: str,
    roles: Mapping[str, str],
    levels: Mapping[str, float] | None = None,
) -> RuleContext:
    """A case of a family.

    Args:
        trace: From a ``Bench``.
        family: ``pcr``, ...
        roles: Names of wells by role, ``{"ntc": "plate:H1 plate:H2"}``.
        levels: Concentration or dose by well.
    """
    found = Roles(DATABASE.family(family))
    for role, places in roles.items():
        for place in places.split():
            labware, _, name = place.partition(":")
            ref = WellRef(labware, name)
            evidence = Evidence(Kind.GIVEN, role, (ref,), "given", role=role)
            found.by_well[ref] = Assignment(role, (evidence,), (levels or {}).get(place))
    return RuleContext(trace, found, DATABASE.common)


def broken(case: RuleContext, rule: str) -> list[Violation]:
    """Where the case breaks a rule of its family."""
    return [one for one in _results(case, rule) if isinstance(one, Violation)]


def doubts(case: RuleContext, rule: str) -> list[str]:
    """What a rule cannot judge of the case."""
    return [one.reason for one in _results(case, rule) if isinstance(one, Doubt)]


def wells(violations: list[Violation]) -> set[str]:
    """The wells that suffer: ``plate:A1``."""
    return {f"{one.well.labware}:{one.well.name}" for one in violations}


def _results(case: RuleContext, rule: str) -> list[Violation | Doubt]:
    (spec,) = (spec for spec in DATABASE.rules if spec.id == rule)
    return [one for data in spec.checks for one in make_check(data, rule).find(case)]
