"""Plates of a run, well by well."""

from __future__ import annotations

from aegis_ot.run_view import plates_of

from .overviews import delivery, overview, row


def cells(*deliveries: dict) -> dict:
    (plate,) = plates_of(overview(*deliveries))
    return plate.wells


def test_a_plate_has_the_size_of_the_smallest_that_holds_its_wells() -> None:
    (plate,) = plates_of(overview(delivery(0), delivery(3)))
    assert (list(plate.rows), list(plate.columns)) == (["A", "B", "C"], [1, 2, 3, 4])
    assert plate.title == "plate, slot 4"
    assert {well: cell.state for well, cell in plate.wells.items()} == {"A1": "pass", "A4": "pass"}


def test_a_plate_that_names_its_size_has_it_from_the_first_well() -> None:
    first = delivery(0)
    first["keyframes"][-1]["destinations"][0]["label"] = "Corning 96 Well Plate"
    (plate,) = plates_of(overview(first))
    assert (len(plate.rows), len(plate.columns)) == (8, 12)


def test_the_gravest_of_several_deliveries_into_a_well_counts() -> None:
    second = delivery(1, "fail")
    for keyframe in second["keyframes"]:
        keyframe["destinations"][0]["name"] = "A1"
    cell = cells(delivery(0), second, delivery(0))["A1"]
    assert (cell.state, cell.trajectory, cell.deliveries) == ("fail", 1, 3)
    assert cell.failure == "partial dispense"


def test_states_of_a_delivery() -> None:
    running = delivery(2, None)
    running["keyframes"] = running["keyframes"][:2]
    found = cells(
        delivery(0, None), delivery(1, "undecided"), running, delivery(3, abandoned="stopped")
    )
    assert [cell.state for cell in found.values()] == [
        "waiting", "undecided", "running", "abandoned",
    ]  # fmt: skip


def test_a_well_that_a_person_decided_says_so() -> None:
    decision = {"outcome": "pass", "by": "Ada", "note": "", "at": 1.0}
    assert cells(delivery(0, decisions=[decision]))["A1"].decided


def test_each_channel_of_a_row_gives_its_well_its_state() -> None:
    found = cells(row(0, "..F?uu.."))
    states = [found[f"{letter}1"].state for letter in "ABCDEFGH"]
    wanted = ["pass", "pass", "fail", "undecided", "unobserved", "unobserved", "pass", "pass"]
    assert states == wanted
    assert (found["C1"].failure, found["A1"].failure) == ("no dispense", "")


def test_a_well_that_was_not_seen_once_is_not_shown_as_passed() -> None:
    again = row(1, "........")
    for keyframe in again["keyframes"]:
        for well in keyframe["destinations"]:
            well["name"] = well["name"].replace("2", "1")
    assert cells(row(0, "uuuuuuuu"), again)["A1"].state == "unobserved"
