"""Names, keys and fields that held wells."""

from __future__ import annotations

from aegis_ot.preflight.evidence import Kind

from ..reading import evidence, read, roles_by_well


def test_a_name_speaks_of_the_wells_that_it_held() -> None:
    reading = read(
        """
        ntc = plate["H12"]
        templates = tubes.rows()[0][:2]
        p20.transfer(2, templates, plate.wells()[:2], new_tip="always")
        p20.transfer(2, tubes["D6"], ntc)
        """
    )
    found = evidence(reading, Kind.NAME)
    assert found["ntc"][1] == ["1:H12"]
    assert found["templates"][1] == ["2:A1", "2:A2"]
    assert "name `ntc` at line" in found["ntc"][0].citation


def test_the_key_of_a_dict_names_its_well() -> None:
    reading = read(
        """
        reagents = {"master mix": tubes["A1"], "water": tubes["A2"]}
        p20.transfer(2, reagents["master mix"], plate["A1"])
        p20.transfer(2, reagents["water"], plate["A1"])
        """
    )
    assert roles_by_well(reading) == {"2:A1": "master_mix", "2:A2": "water"}


def test_a_field_of_rows_names_all_of_its_column() -> None:
    reading = read(
        """
        rows = [
            {"template": tubes["B1"], "reaction": plate["A1"]},
            {"template": tubes["B2"], "reaction": plate["B1"]},
        ]
        for row in rows:
            p20.transfer(2, row["template"], row["reaction"])
        """
    )
    found = evidence(reading, Kind.NAME)
    assert found["rows.template"][1] == ["2:B1", "2:B2"]
    assert found["rows.reaction"][1] == ["1:A1", "1:B1"]


def test_numbers_in_keys_are_levels_and_running_numbers_are_none() -> None:
    reading = read(
        """
        standards = {0: tubes["A1"], 125: tubes["A2"], 250: tubes["A3"]}
        samples = {1: tubes["B1"], 2: tubes["B2"]}
        for well, tube in zip(plate.wells(), [*standards.values(), *samples.values()]):
            p20.transfer(2, tube, well)
        """,
        assay="bradford",
    )
    (roles,) = reading.roles
    levels = {ref.address: roles.level(ref) for ref in roles.by_well}
    assert [levels[well] for well in ("2:A1", "2:A2", "2:A3")] == [0, 125, 250]
    assert levels["2:B1"] is None


def test_a_list_of_concentrations_beside_a_list_of_wells_gives_their_levels() -> None:
    reading = read(
        """
        standards = tubes.rows()[0][:3]
        standard_conc = [0, 250, 1000]
        p20.transfer(2, standards, plate.wells()[:3], new_tip="always")
        """,
        assay="bradford",
    )
    assert evidence(reading, Kind.NAME)["standards"][0].levels == (0, 250, 1000)


def test_a_loop_variable_says_nothing_that_its_list_does_not() -> None:
    reading = read(
        """
        templates = tubes.rows()[0][:2]
        for template, well in zip(templates, plate.wells()):
            p20.transfer(2, template, well)
        """
    )
    assert "template" not in evidence(reading, Kind.NAME)
    assert set(roles_by_well(reading)) == {"2:A1", "2:A2"}


def test_of_two_lists_of_levels_of_one_name_that_of_the_wells_own_function_counts() -> None:
    reading = read(
        """
        def fill(concs):
            STANDARD_CONCS = [9, 8, 7]
            return concs
        standards = [tubes["A1"], tubes["A2"], tubes["A3"]]
        STANDARD_CONCS = [2000, 1000, 0]
        fill(STANDARD_CONCS)
        for well, tube in zip(plate.wells(), standards):
            p20.transfer(2, tube, well)
        """,
        assay="bradford",
    )
    assert evidence(reading, Kind.NAME)["standards"][0].levels == (2000.0, 1000.0, 0.0)
