"""Which assay a protocol is taken for, and how far that carries."""

from __future__ import annotations

import pytest

from aegis_ot.vocabulary import Severity

from ..judging.test_doubts import checked

DYE_FIRST = """
dye = trough["A1"]
samples = rack.rows()[1][:4]
p300.transfer(100, dye, plate.columns()[1][:4])
p300.transfer(20, samples, plate.columns()[1][:4], new_tip="always", mix_after=(3, 50))
"""
STANDARDS = """
bsa = rack["C1"]
standards, samples = rack.rows()[0], rack.rows()[1]
p300.transfer(50, bsa, plate.columns()[0][:6])
p300.transfer(50, standards, plate.columns()[0][:6], new_tip="always")
p300.transfer(50, samples, plate.columns()[1][:6], new_tip="once")
"""


def test_a_comment_alone_tells_the_assay_and_makes_no_error() -> None:
    assert checked(DYE_FIRST).findings == ()
    head = "# Not the Bradford protein assay any more"
    (found,) = checked(DYE_FIRST, head=head).findings
    assert (found.rule, found.severity) == ("BRD-4", Severity.WARNING)
    told = "Only a comment or docstring says which assay this is (bradford)."
    assert found.message.endswith(told)
    (found,) = checked(DYE_FIRST, title="Bradford assay", head=head).findings
    assert (found.rule, found.severity) == ("BRD-4", Severity.ERROR)
    roles = {"dye": ["4:A1"]}
    (found,) = checked(DYE_FIRST, head=head, roles=roles).findings
    assert (found.rule, found.severity) == ("BRD-4", Severity.ERROR)


@pytest.mark.parametrize("title", ["qPCR standards", "Standard curve of the master mix with BSA"])
def test_words_of_pcr_exclude_a_protein_assay(title: str) -> None:
    report = checked(STANDARDS, title=title)
    assert "bradford" not in {one.family for one in report.families if one.applies}
    assert not any(one.rule.startswith("BRD") for one in (*report.findings, *report.undecided))


def test_a_protein_assay_on_a_pcr_plate_is_one() -> None:
    report = checked(STANDARDS, title="BCA assay of lysates in a PCR plate")
    assert report.family == "bradford"
