"""What the words of a name say that a well holds."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.evidence import Clue, Strength
from aegis_ot.preflight.roles.phrases import roles_named
from aegis_ot.preflight.roles.role_words import role_words

DATABASE = load_database()


@pytest.mark.parametrize(
    ("family", "text", "role"),
    [
        ("cell_treatment", "plain DMEM", "medium"),
        ("cell_treatment", "glucagon in DMEM", None),
        ("cell_treatment", "drug in DMEM", "drug"),
        ("pcr", "no gDNA", "ntc"),
        ("pcr", "NO_CDNA", "ntc"),
        ("cell_treatment", "no LPS", "control"),
        ("cell_treatment", "cisplatin free", "control"),
        ("cell_treatment", "ohne Cisplatin", "control"),
        ("bradford", "QC high", "sample"),
        ("pcr", "river water", "template"),
    ],
)
def test_the_head_of_a_name(family: str, text: str, role: str | None) -> None:
    lexicon = role_words(DATABASE.family(family), DATABASE.common)
    named = roles_named(lexicon, Clue(Strength.NAME, text, (), 1, text), DATABASE.common)
    assert (role in named) if role else not named


@pytest.mark.parametrize(
    ("text", "role"),
    [
        ("3 mM in DMSO", None),
        ("40 ug/ml in PBS", None),
        ("DMSO", "vehicle"),
        ("in DMSO", "vehicle"),
    ],
)
def test_a_concentration_in_a_solvent_is_not_the_solvent(text: str, role: str | None) -> None:
    lexicon = role_words(DATABASE.family("cell_treatment"), DATABASE.common)
    clue = Clue(Strength.COMMENT, text, (), 1, text, subject=False)
    named = roles_named(lexicon, clue, DATABASE.common)
    assert (role in named) if role else not named
