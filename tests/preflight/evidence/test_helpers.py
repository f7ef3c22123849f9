"""What the name of a helper function says that it gives."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.evidence.helpers import thing_given
from aegis_ot.preflight.text import tokens


@pytest.mark.parametrize(
    ("name", "thing"),
    [
        ("add_water", "water"),
        ("_dispenseDyeReagent", "dye reagent"),
        ("add_dye_to_standards", "dye"),
        ("step2_add_template", "template"),
        ("dispense_and_mix_sample", "sample"),
        ("add_diluent_and_mix", "diluent"),
        ("fill_wells_with_medium", "medium"),
        ("puffer_zugeben", "puffer"),
        ("ajouter_tampon", "tampon"),
        ("agregar_diluyente", "diluyente"),
        ("add_sample_and_dye", ""),
        ("fill_standards", ""),
        ("treat_cells", ""),
        ("make_master_mix", ""),
        ("master_mix_into", "master mix"),
        ("water_instead_of_template", "water"),
        ("mix_into", ""),
        ("buffer_and_dye_into", ""),
        ("run", ""),
        ("transfer", ""),
    ],
)
def test_a_name_says_one_thing_that_is_given_or_nothing(name: str, thing: str) -> None:
    assert tokens(thing_given(name, load_database().common)) == tokens(thing)
