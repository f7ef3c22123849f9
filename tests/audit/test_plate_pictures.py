"""Colour changes against the record: the wells that contradict it, no others, in words."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from aegis_ot.audit.plate_fit import PlateReading, read_plate
from aegis_ot.audit.plate_record import RecordedPlate, RecordedWell
from aegis_ot.audit.plate_words import contradiction_words, doubt_words, unjudged_words
from aegis_ot.sidecar.overview import run_overview
from aegis_ot.sidecar.store import Store
from aegis_ot.simulation.dyes import DYES
from aegis_ot.vision.plate import FORMATS, Change
from scripts.plates_from_above.rendering import PlateShot, WellContent, render_plate
from tests.cli.commands import Command
from tests.sidecar.browser import CHROMIUM, chromium

PLATE = FORMATS[96]
RED = np.array([1.0, 1.1, 0.1]) / 100
"""Absorbed per µL."""


def record(**wells: dict[str, float]) -> RecordedPlate:
    told = {well: RecordedWell(gained, sum(gained.values())) for well, gained in wells.items()}
    return RecordedPlate("plate, slot 3", PLATE, told)


def row(letter: str, **gained: float) -> dict[str, dict[str, float]]:
    return {f"{letter}{column}": gained for column in range(1, 13)}


def seen(**shown: float) -> Change:
    """What wells show, in µL of the red dye; the others nothing."""
    absorbed = np.random.default_rng(1).normal(0, 0.01, (96, 3))
    for well, ul in shown.items():
        absorbed[PLATE.names.index(well)] += RED * ul
    return Change(np.repeat(absorbed[:, None], 4, axis=1), np.zeros(96, bool))


def states(reading: PlateReading) -> dict[str, str]:
    return {one.well: one.state for one in reading.wells}


def filled(letter: str, ul: float) -> dict[str, float]:
    return {f"{letter}{column}": ul for column in range(1, 13)}


def test_wells_that_got_nothing_half_or_what_nobody_put_there_are_named_and_no_others() -> None:
    told = record(**row("A", red=100.0), **row("B", red=50.0))
    shown = filled("A", 100) | filled("B", 50) | {"A3": 0, "B4": 0, "A7": 50, "H1": 80}
    reading = read_plate(seen(**shown), told)
    said = " ".join(contradiction_words(reading, told))
    assert "A3 shows no change although 100 µL of red were dispensed into it." in said
    assert "B4 shows no change although 50 µL of red were dispensed into it." in said
    assert "A7 shows 50 % of the change" in said
    assert "H1 changed although the record tells of no delivery into it." in said
    off = {well for well, state in states(reading).items() if state == "contradicts"}
    assert off == {"A3", "B4", "A7", "H1"}
    assert set(states(reading).values()) == {"agrees", "contradicts"}
    assert doubt_words(reading, told, "b.jpg", "a.jpg") == ""


def test_a_group_that_failed_as_a_whole_is_named_by_the_other_group_of_its_liquid() -> None:
    told = record(**row("A", red=100.0), **row("B", red=50.0), **row("C", red=50.0))
    reading = read_plate(seen(**filled("C", 50)), told)
    silent = {well for well, state in states(reading).items() if state == "contradicts"}
    assert silent == {*row("A"), *row("B")}
    mixed = record(**row("A", red=50.0, buffer=50.0), **row("B", red=50.0), **row("C", buffer=9.0))
    reading = read_plate(seen(**filled("B", 50)), mixed)
    assert {well for well, state in states(reading).items() if state == "contradicts"} == set(
        row("A")
    )


def test_what_the_pictures_cannot_tell_is_listed_and_neither_passed_nor_accused() -> None:
    told = record(**row("A", red=100.0), **row("B", buffer=100.0), C1={"dye of X": 50.0})
    told.wells["A1"].unknown = True
    change = seen(**filled("A", 100) | {"C1": 70})
    change.blinded[PLATE.names.index("A2")] = True
    change.blinded[PLATE.names.index("H12")] = True
    reading = read_plate(change, told)
    why = {one.well: one.why for one in reading.wells if one.state == "unjudged"}
    assert why == {"A1": "unknown", "A2": "hidden", "H12": "hidden", "C1": "alone"} | dict.fromkeys(
        row("B"), "faint"
    )
    said = "\n".join(unjudged_words(reading, told))
    assert "none of these 12 wells shows a change" in said
    assert "Buffer: too clear or too little for these pictures, or nothing arrived" in said
    assert "A2, H12: glare" in said
    assert not reading.of("contradicts")


def test_a_well_that_contradicts_in_part_or_became_lighter_is_listed_and_not_accused() -> None:
    told = record(**row("A", red=100.0), **row("B", red=50.0))
    change = seen(**filled("A", 100) | filled("B", 50) | {"A1": 0, "A2": 0, "A3": -60, "H1": -60})
    shaded, floor = PLATE.names.index("H12"), PLATE.names.index("A2")
    change.absorbed[shaded, :3] += 0.5  # a wall: all of an empty well but one quarter
    change.absorbed[floor, 3] += RED * 100
    reading = read_plate(change, told)
    assert [one.well for one in reading.of("contradicts")] == ["A1"]
    why = {one.well: one.why for one in reading.of("unjudged")}
    assert why == {"A2": "uneven", "H12": "uneven", "A3": "lighter", "H1": "lighter"}
    said = "\n".join(unjudged_words(reading, told))
    assert "part of them contradicts the record and part agrees" in said
    assert "A3, H1: they became lighter" in said


def test_where_half_would_look_alike_a_well_is_not_said_to_agree() -> None:
    told = record(**row("A", red=100.0), **row("B", red=10.0))
    reading = read_plate(seen(**filled("A", 100) | filled("B", 10) | {"B3": 0}), told)
    assert states(reading)["B3"] == "contradicts"
    assert {one.well for one in reading.wells if one.why == "weak"} == set(row("B")) - {"B3"}


def test_a_whole_plate_of_one_volume_needs_no_empty_wells() -> None:
    told = record(**{well: {"red": 100.0} for well in PLATE.names})
    reading = read_plate(seen(**dict.fromkeys(PLATE.names, 100.0) | {"D5": 0.0}), told)
    assert [one.well for one in reading.of("contradicts")] == ["D5"]


def test_what_the_run_failed_is_no_news_and_what_arrived_after_all_is_said() -> None:
    told = record(**row("A", red=100.0))
    told.wells["A1"].failed = told.wells["A2"].failed = True
    reading = read_plate(seen(**filled("A", 100) | {"A1": 0.0}), told)
    assert contradiction_words(reading, told)[0].endswith("The run had failed it, too.")
    assert reading.contradicting == 0
    assert {one.well: one.state for one in reading.wells if one.why} == {
        "A1": "contradicts",
        "A2": "agrees",
    }


def test_pictures_that_fit_badly_as_a_whole_are_doubted_instead_of_their_wells() -> None:
    told = record(**row("A", red=100.0))
    swapped = read_plate(seen(**filled("A", -100)), told)
    assert "wrong order" in doubt_words(swapped, told, "b.jpg", "a.jpg")
    nothing = read_plate(seen(), told)
    assert "None of the wells" in doubt_words(nothing, told, "b.jpg", "a.jpg")
    other = filled("C", 60) | filled("D", 60) | filled("E", 60)
    messy = read_plate(seen(**filled("A", 100) | other), told)
    assert "rather the pictures are wrong" in doubt_words(messy, told, "b.jpg", "a.jpg")


SHOT = PlateShot(width=800, height=600, tilt_deg=(3.0, -2.0), turn_deg=5.0)
AFTER = replace(SHOT, tilt_deg=(-2.0, 2.0), turn_deg=-3.0, seed=1)
"""Rendered pictures of the plate of the recorded run; C1 got nothing."""


@pytest.fixture(scope="module")
def pictures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pictures")
    dye = ((DYES["red"], 0.3),)
    contents = {f"{letter}1": WellContent(150, dye) for letter in "ABDEFGH"}
    for name, held, shot in (
        ("before", {}, SHOT),
        ("after", contents, AFTER),
        ("turned", contents, replace(AFTER, turn_deg=177.0)),
    ):
        cv2.imwrite(str(folder / f"{name}.png"), render_plate(PLATE, held, shot)[0])
    (folder / "text.png").write_text("no picture")
    return folder


@pytest.fixture
def audit(
    copied: Callable[[], Store], pictures: Path, capfdbinary: pytest.CaptureFixture[bytes]
) -> Callable[..., tuple[int, str]]:
    store, aegis = copied(), Command(capfdbinary)

    def run(before: str, after: str, *more: object, wells: int = 96) -> tuple[int, str]:
        done = aegis("audit", "--data", store.folder, "--plate", pictures / before,
                     pictures / after, "--plate-wells", wells, *more)  # fmt: skip
        kept = run_overview(store, "run-1")["audit"]
        assert done.code == 2 or kept["plate"]["title"] == "plate, off deck"
        return done.code, done.out + done.err

    return run


def test_the_command_names_the_well_and_the_page_shows_it(
    audit: Callable[..., tuple[int, str]], tmp_path: Path
) -> None:
    page = tmp_path / "audit.html"
    code, said = audit("before.png", "after.png", "--out", page)
    assert code == 1
    assert "C1 shows no change although 150 µL of red dye from A1 of dye were dispensed" in said
    assert "1 contradicts it" in said
    text = page.read_text("utf-8")
    assert 'aria-label="C1: contradicts the record"' in text
    assert "after; ringed: A1" in text
    if CHROMIUM is not None:
        with chromium((390, 844)) as browser:
            browser.open(page.as_uri())
            browser.until("document.querySelectorAll('.closeups article').length === 1")
            assert browser.run("document.documentElement.scrollWidth <= innerWidth")
            assert browser.errors == []


def test_a_turned_plate_is_noticed_and_read_once_its_corner_is_told(
    audit: Callable[..., tuple[int, str]],
) -> None:
    code, said = audit("before.png", "turned.png")
    assert (code, "--a1 bottom-right" in said, "C1 shows" in said) == (1, True, False)
    assert "96 not judged" in said
    code, said = audit("before.png", "turned.png", "--a1", "top-left", "--a1", "bottom-right")
    assert (code, "C1 shows no change" in said) == (1, True)


def test_what_cannot_be_compared_is_said_without_a_traceback(
    audit: Callable[..., tuple[int, str]],
) -> None:
    for before, after, more, words in (
        ("nowhere.png", "after.png", (), "cannot be read"),
        ("text.png", "after.png", (), "no picture"),
        ("before.png", "before.png", (), "the same picture"),
        ("before.png", "after.png", ("--a1", "top"), "--a1 is one of"),
        ("before.png", "after.png", ("--a1", "top-right"), "lies lengthwise"),
        ("before.png", "after.png", ("--plate-slot", "9"), "none of them is '9'"),
    ):
        code, said = audit(before, after, *more)
        assert (code, words in said, "Traceback" in said) == (2, True, False), said


def test_options_without_pictures_are_refused(
    passed: Path, capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    done = Command(capfdbinary)("audit", "--data", passed, "--a1", "top-left")
    assert (done.code, "Give two with --plate" in done.err) == (2, True)
