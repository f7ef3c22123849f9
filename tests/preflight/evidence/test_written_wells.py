"""Wells written out count only where a whole block reads so, and never accuse alone."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.evidence import DOUBTFUL, Kind

from ..reading import evidence, read, roles_by_well

RUN = """
{comment}
p20.transfer(2, tubes["A1"], plate["A1"])
p20.transfer(2, tubes["A2"], plate["H12"])
"""


def told(comment: str) -> dict[str, list[str]]:
    reading = read(RUN.format(comment=comment), label='"PCR plate"')
    return {text: wells for text, (_, wells) in evidence(reading, Kind.WRITTEN).items()}


@pytest.mark.parametrize(
    "comment",
    [
        "# PCR plate: A1 sample, H12: NTC",
        "# PCR plate:\n# A1 sample\n# H12 NTC",
        "# PCR plate: sample in A1, NTC in H12",
        "# Slot 1 is no labware here\n\n# PCR plate: A1 sample; H12 NTC",
    ],
)
def test_a_block_that_lists_wells_of_its_labware_is_read(comment: str) -> None:
    assert told(comment) == {"sample": ["1:A1"], "NTC": ["1:H12"]}


@pytest.mark.parametrize(
    "comment",
    [
        "# A1 sample, H12: NTC",  # names no labware
        "# PCR plate: A1 sample, H12: NTC and everything else stays empty this time",
        "# PCR plate: the last well is the NTC (H12)",
        "# The NTC is in H12 of the PCR plate.",
        "# PCR plate: see the protocol's page for H12",
    ],
)
def test_what_says_more_is_prose_and_left_alone(comment: str) -> None:
    assert told(comment) == {}


def test_what_is_written_is_the_weakest_evidence_of_the_program() -> None:
    reading = read(RUN.format(comment="# PCR plate: A1 NTC, H12: sample"), label='"PCR plate"')
    assert Kind.WRITTEN in DOUBTFUL
    (roles,) = reading.roles
    assert roles_by_well(reading)["1:A1"] == "ntc"
    assert [ref.address for ref in roles.by_well if roles.is_doubtful(ref)] == ["1:A1"]


def test_a_word_for_a_liquid_and_its_wells_alike_goes_by_what_the_run_does() -> None:
    reading = read(
        RUN.format(comment="# PCR plate: A1 positive control, H12: NTC"), label='"PCR plate"'
    )
    assert roles_by_well(reading)["1:A1"] == "positive_reaction"
    reading = read(RUN.format(comment="# slot 2: A1: positive control"), label='"PCR plate"')
    assert roles_by_well(reading)["2:A1"] == "positive_control"
