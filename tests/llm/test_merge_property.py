"""Whatever a model says, the checks' result stands: issue 4, "no model may lower it"."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aegis_ot.llm import ScriptedBackend, State, hybrid
from aegis_ot.preflight import Report
from aegis_ot.vocabulary import Dossier, Severity, VerdictWord

from .samples import CONTAMINATED, PROSE, SILENT, examined, rule_set

WAIVED = SILENT.replace(
    'p20.mix(2, 10, plate["H12"])',
    'p20.mix(2, 10, plate["H12"])  # aegis: ignore[PCR-2] water only',
)
WAIVED_FAULT = CONTAMINATED.replace(
    "p20.mix(2, 10, ntc)", "p20.mix(2, 10, ntc)  # aegis: ignore[PCR-2] water only"
)
PROTOCOLS = [CONTAMINATED, SILENT, PROSE, WAIVED, WAIVED_FAULT]
NAMES = ["fault", "silent", "prose", "waived", "waived-fault"]

RANK = {VerdictWord.PASS: 0, VerdictWord.WARN: 1, VerdictWord.FAIL: 2, VerdictWord.ERROR: 3}


def _rules() -> st.SearchStrategy[str]:
    known = [rule.id for rule in rule_set().rules]
    return st.one_of(st.sampled_from([*known, "MODEL", "PCR-99"]), st.text(max_size=8))


def _families() -> st.SearchStrategy[str]:
    known = [family.family for family in rule_set().families]
    return st.one_of(st.sampled_from([*known, ""]), st.text(max_size=8))


def _roles() -> st.SearchStrategy[str]:
    known = sorted({role for family in rule_set().families for role in family.roles})
    return st.one_of(st.sampled_from(known), st.text(max_size=8))


WELLS = st.lists(
    st.one_of(
        st.sampled_from(
            ["2:A1", "2:A2", "2:A3", "4:A1", "4:H12", "4:A1-H12", "PCR plate:A1", "9:A1", "H12", ""]
        ),
        st.text(max_size=12),
    ),
    max_size=4,
)
WORDS = st.text(max_size=60)


def answers() -> st.SearchStrategy[dict[str, Any]]:
    """Everything that fits the schema."""
    finding = st.fixed_dictionaries(
        {
            "rule": _rules(),
            "message": WORDS,
            "wells": WELLS,
            "lines": st.lists(st.integers(-5, 40), max_size=4),
            "why": WORDS,
            "fix": WORDS,
        }
    )
    quote = st.one_of(
        WORDS,
        st.sampled_from(
            ["the first one is the master mix", "second one", "no-template control", "tubes", "1"]
        ),
    )
    role = st.fixed_dictionaries(
        {
            "role": _roles(),
            "wells": WELLS,
            "levels": st.lists(
                st.one_of(st.sampled_from(["1", "0", "5 mM", "nan"]), WORDS), max_size=2
            ),
            "citations": st.lists(
                st.fixed_dictionaries({"line": st.integers(-5, 40), "quote": quote}), max_size=2
            ),
        }
    )
    reading = st.fixed_dictionaries(
        {
            "rule": _rules(),
            "answer": st.sampled_from(["holds", "violated", "cannot_tell"]),
            "reason": WORDS,
            "wells": WELLS,
            "lines": st.lists(st.integers(-5, 40), max_size=4),
        }
    )
    return st.fixed_dictionaries(
        {
            "family": _families(),
            "roles": st.lists(role, max_size=5),
            "answers": st.lists(reading, max_size=6),
            "findings": st.lists(finding, max_size=5),
            "summary": WORDS,
        }
    )


def stands(before: Report, after: Report, dossier: Dossier) -> None:
    assert set(before.findings) <= set(after.findings)
    assert RANK[after.verdict] >= RANK[before.verdict]
    assert set(before.waived) <= set(after.waived)
    assert set(before.roles) <= set(after.roles)
    added = [finding for finding in after.findings if finding not in before.findings]
    assert all(finding.source == "model" for finding in added)
    assert all(finding.severity is Severity.WARNING for finding in added)
    for finding in added:
        assert {well.labware for well in finding.wells} <= {item.key for item in dossier.deck}
        assert set(finding.lines) <= set(dossier.lines)
    told = {undecided.rule for undecided in after.undecided}
    for undecided in before.undecided:
        assert undecided.rule in told | {finding.rule for finding in added}
    decided = {brief.id for brief in dossier.rules if brief.decided}
    assert decided.isdisjoint(finding.rule for finding in added)


@pytest.mark.parametrize("text", PROTOCOLS, ids=NAMES)
@settings(max_examples=60, deadline=None)
@given(said=answers())
def test_no_answer_takes_anything_from_the_checks(text: str, said: dict[str, Any]) -> None:
    before, dossier, reading = examined(text)
    after = hybrid(before, dossier, reading, ScriptedBackend([said]))
    assert not after.unanswered
    stands(before, after.report, dossier)


@pytest.mark.parametrize("text", PROTOCOLS, ids=NAMES)
@settings(max_examples=40, deadline=None)
@given(
    said=st.one_of(
        st.text(),
        st.sampled_from([state for state in State if state is not State.ANSWERED]),
        st.recursive(
            st.none() | st.booleans() | st.integers() | st.text(),
            lambda inner: (
                st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3)
            ),
        ).map(json.dumps),
    )
)
def test_no_nonsense_takes_anything_from_the_checks(text: str, said: str | State) -> None:
    before, dossier, reading = examined(text)
    after = hybrid(before, dossier, reading, ScriptedBackend([said]))
    assert after.unanswered
    stands(before, after.report, dossier)


def test_a_waiver_of_an_undecided_rule_is_not_stale_and_covers_the_models_finding() -> None:
    before, dossier, reading = examined(WAIVED)
    assert before.remarks == ()
    said = {
        "family": "pcr", "roles": [], "answers": [], "summary": "",
        "findings": [
            {"rule": "PCR-2", "message": "It mixes H12.", "wells": ["2:A2", "4:H12"],
             "lines": [11, 15], "why": "", "fix": ""}
        ],
    }  # fmt: skip
    after = hybrid(before, dossier, reading, ScriptedBackend([said])).report
    assert [waived.finding.rule for waived in after.waived] == ["PCR-2"]
    assert after.remarks == ()
