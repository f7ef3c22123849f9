"""Words of a list in identifiers and texts, however they are spelled."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.text import Lexicon, tokens


@pytest.mark.parametrize(
    ("written", "plain"),
    [
        ("stammloesung", "Stammlösung"),
        ("verduennungspuffer", "Verdünnungspuffer"),
        ("œstradiol", "oestradiol"),
        ("temoinSolvant", "témoin_solvant"),
    ],
)
def test_letters_may_be_written_out(written: str, plain: str) -> None:
    assert tokens(written) == tokens(plain)


def test_a_compound_is_read_by_its_last_part() -> None:
    lexicon = Lexicon({"dye": ["reagenz"], "plate": ["platte"]}, endings=("reagenz", "platte"))
    assert [match.topic for match in lexicon.find("bradfordreagenz")] == ["dye"]
    assert [match.topic for match in lexicon.find("MHK-Zellplatte")] == ["plate"]
    assert lexicon.words("reagenz") == ("reagenz",)


def test_a_compound_with_a_meaning_of_its_own_stays_whole() -> None:
    lexicon = Lexicon({"drug": ["probe"], "control": ["leerprobe"]}, endings=("probe",))
    assert [match.topic for match in lexicon.find("leerprobe")] == ["control"]


def test_without_endings_no_word_is_cut() -> None:
    assert not Lexicon({"body": ["body"]}).find("antibody")


def test_a_capital_inside_a_listed_word_does_not_cut_it() -> None:
    lexicon = Lexicon({"cells": ["hela"], "drug": ["sirna"], "template": ["dna"]})
    assert [m.topic for m in lexicon.find("HeLa")] == ["cells"]
    assert [m.topic for m in lexicon.find("siRNA for heLa")] == ["drug", "cells"]
    assert [m.topic for m in lexicon.find("gDNA, halfEmpty")] == ["template"]
