"""The page plays a rehearsal: deck, steps, what wells and tips hold, findings where they happen."""

from __future__ import annotations

import functools
import json
import re
from collections.abc import Iterator
from typing import Any

import pytest

from aegis_ot.adapters.opentrons.instrumentation import LabwareInfo, WellInfo
from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.preflight import Interpretation, Options, judge, load_rules, record
from aegis_ot.reports.check_html import check_html
from aegis_ot.vocabulary import Site, WellRef
from aegis_ot.workbench import CheckedProtocol, CheckRun
from aegis_ot.workbench.playback import marks_of, playback_of
from tests.sidecar.browser import CHROMIUM, Browser, chromium

NASTY = "</script><script>window.hurt = 1</script><img src=x onerror='window.hurt = 1'>"

PROTOCOL = f"""
requirements = {{"robotType": "OT-2", "apiLevel": "2.19"}}

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    stock = protocol.load_labware("nest_12_reservoir_15ml", "2", {NASTY!r})
    plate = protocol.load_labware("corning_384_wellplate_112ul_flat", "3", "assay")
    tubes = protocol.load_labware("nest_96_wellplate_200ul_flat", "5", "tubes")
    columns = protocol.load_labware("nest_96_wellplate_200ul_flat", "7", "filter plate")
    water = protocol.define_liquid("water " + {NASTY!r}, "", "#00f")
    stock["A1"].load_liquid(water, 5000)
    one = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    eight = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])
    eight.transfer(100, stock["A1"], tubes["A1"])
    one.pick_up_tip()
    one.aspirate(60, tubes["A1"])
    one.air_gap(20)
    one.dispense(50, plate["B2"])
    one.dispense(10, columns["A1"])
    one.return_tip()
    one.transfer(30, stock["A2"], plate.wells()[:3], mix_after=(2, 20))
    protocol.move_labware(plate, "6")
    protocol.pause("Look at it.")
    one.transfer(500, tubes["B3"], tubes["C1"])
    one.transfer(150, tubes["D2"], tubes["E2"])
    one.transfer(50, stock["A1"], tubes["D2"])
"""

LOOP = """
requirements = {"robotType": "OT-2", "apiLevel": "2.19"}

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "3")
    water = protocol.define_liquid("water", "", "#00f")
    plate["A1"].load_liquid(water, 100)
    one = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for well in plate.columns()[1][:3]:
        one.pick_up_tip()
        one.aspirate(60, plate["A1"])
        one.dispense(60, well)
        one.mix(3, 30, well)
        one.drop_tip()
"""


@functools.cache
def checked(text: str = PROTOCOL) -> CheckedProtocol:
    recording = record(Script(text=text, file_name="f.py"))
    reading = Interpretation(recording, load_rules(), Options())
    report = judge(reading)
    lines = tuple(text.splitlines())
    return CheckedProtocol(
        "f.py", report, lines=lines, playback=json.loads(json.dumps(playback_of(reading, report)))
    )


@pytest.fixture(scope="module")
def page() -> str:
    return check_html(CheckRun((checked(),), load_rules(), "1"))


def test_a_rehearsal_is_small_plain_values() -> None:
    values = checked().playback
    assert values is not None
    kinds = [step[0] for step in values["steps"]]
    assert kinds[:4] == ["pick", "draw", "give", "drop"]
    assert {"air", "move", "pause"} <= {*kinds}
    draw = values["steps"][1]
    assert draw[3] == 100.0
    nozzles, wells = values["groups"][draw[4]]
    assert nozzles == [f"{row}1" for row in "ABCDEFGH"]
    assert len({*wells}) == 1, "eight tips in one trough"
    assert {one["kind"] for one in values["labware"]} == {"tips", "wells"}
    held = [(volume, name) for _, volume, name, _ in values["start"] if volume]
    assert held == [(5000.0, "water " + NASTY)]


def test_a_finding_is_marked_at_the_steps_where_it_happened() -> None:
    found = checked()
    assert found.playback is not None
    finding = next(one for one in found.findings if one.rule == "HND-6")
    steps = marks_of(found.playback, finding.sites)
    lines = [found.playback["steps"][step][1] for step in steps]
    assert lines == list(finding.lines)
    assert marks_of(found.playback, [Site(None)]) == []
    assert marks_of(found.playback, [Site(9999)]) == []
    assert marks_of(found.playback, [Site(9999, finding.wells[0])]) == []


def test_in_a_loop_the_time_is_marked_that_is_meant() -> None:
    found = checked(LOOP)
    assert found.playback is not None
    kinds = [step[0] for step in found.playback["steps"]]
    draws = [n for n, kind in enumerate(kinds) if kind == "draw"]
    finding = next(one for one in found.findings if "A1" in one.message)
    assert "which holds" in finding.message or "are left" in finding.message
    assert marks_of(found.playback, finding.sites) == [draws[4]], "one of its own, three of a mix"


def test_where_nothing_tells_which_time_is_meant_no_step_is_marked() -> None:
    found = checked(LOOP)
    assert found.playback is not None
    at = {name: n for n, line in enumerate(found.lines, 1) for name in (line.strip()[:9],)}
    key = found.findings[0].wells[0].labware
    assert marks_of(found.playback, [Site(at["one.aspir"], WellRef(key, "A1", "", ""))]) == []
    assert marks_of(found.playback, [Site(at["one.mix(3"])]) == []
    mixed = marks_of(found.playback, [Site(at["one.mix(3"], WellRef(key, "B2", "", ""))])
    assert [found.playback["steps"][n][:2] for n in mixed] == [["draw", at["one.mix(3"]]]


def test_a_labware_without_geometry_is_drawn_without_wells() -> None:
    """Wells of no size, and labware of no wells, are data that real definitions hold."""
    from aegis_ot.workbench.playback import _Playback

    bare = LabwareInfo("a", "x", "X", "", "1", False, False, wells={"A1": WellInfo(0, 0)})
    assert _Playback({"a": bare}).values["shapes"] == [{"wells": [["A1", 0, 0, 0, 0, 0, 0]]}]


def test_the_page_needs_nothing_from_outside_and_names_are_no_markup(page: str) -> None:
    assert not re.search(r'(src|href)="(?!#)', page)
    assert "default-src 'none'" in page
    assert page.count("<script") == 2, "the steps, and what plays them"
    assert page.count("</script>") == 2
    assert "<img" not in page
    assert len(page) < 150_000


@pytest.fixture(scope="module")
def tab(tmp_path_factory: pytest.TempPathFactory, page: str) -> Iterator[Browser]:
    if CHROMIUM is None:
        pytest.skip("no Chromium")
    folder = tmp_path_factory.mktemp("playback")
    (folder / "page.html").write_text(page, encoding="utf-8")
    with chromium() as browser:
        browser.open((folder / "page.html").as_uri())
        browser.until("document.querySelector('.told')?.textContent")
        yield browser


def text(tab: Browser, selector: str) -> Any:
    return tab.run(f"document.querySelector({selector!r}).textContent")


def go(tab: Browser, step: int) -> None:
    tab.run(
        "new Promise((done) => { const slider = document.querySelector('input[type=range]');"
        f" slider.value = {step}; slider.dispatchEvent(new Event('input'));"
        " requestAnimationFrame(() => requestAnimationFrame(done)); })"
    )


def press(tab: Browser, key: str) -> None:
    event = f"new KeyboardEvent('keydown', {{key: {key!r}, bubbles: true}})"
    tab.run(f"document.body.dispatchEvent({event})")


def step_of(line: str, kind: str) -> int:
    """Number of steps done after the first such step of the line that holds this text."""
    found = checked()
    assert found.playback is not None
    number = next(n for n, one in enumerate(found.lines, 1) if line in one)
    return 1 + next(
        n for n, step in enumerate(found.playback["steps"]) if step[:2] == [kind, number]
    )


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
class TestInChromium:
    def test_it_says_what_each_tip_and_well_holds(self, tab: Browser) -> None:
        go(tab, step_of("one.dispense(50", "give"))
        assert text(tab, ".told").startswith("Gives 50 µL into B2 of assay (slot 3)")
        assert text(tab, ".source code").endswith('one.dispense(50, plate["B2"])')
        # The air gap left first: 30 µL of the 60 are in the well, 30 in the tip.
        held = text(tab, ".pipette:not(.idle)")
        assert "30 µL" in held
        assert NASTY in held
        title = "document.querySelector('.closer svg title')"
        assert tab.run(
            f"[...document.querySelectorAll('.closer svg title')].map((one) => one.textContent)"
            f".includes('B2: 30 µL') && {title} !== null"
        )

    def test_going_back_shows_what_was(self, tab: Browser) -> None:
        go(tab, step_of("one.aspirate(60", "draw"))
        assert "60 µL" in text(tab, ".pipette:not(.idle)")
        press(tab, "ArrowLeft")
        assert "no liquid" in text(tab, ".pipette:not(.idle)")
        press(tab, "Home")
        assert text(tab, ".told") == "Before the first step."

    def test_a_finding_leads_to_its_step(self, tab: Browser) -> None:
        press(tab, "Home")
        tab.run("document.querySelector('.finding.error .goto').click()")
        assert "tubes" in text(tab, ".told")
        assert tab.run("document.querySelector('.marks .here') !== null")
        assert tab.run("document.querySelectorAll('.ticks i').length") >= 1

    def test_the_list_of_needs_counts_tips_and_stock(self, tab: Browser) -> None:
        needs = text(tab, ".needs")
        assert "13 tips" in needs
        assert "850 µL of 5,000 µL" in needs
        assert "A2" in needs
        assert "90 µL" in needs

    def test_a_plate_moves_and_a_well_tells_its_steps(self, tab: Browser) -> None:
        press(tab, "End")
        assert tab.run("document.querySelectorAll('.deck .hole').length") == 12 + 384 + 2 * 96
        tab.run(
            "[...document.querySelectorAll('.deck .hole')].find((one) =>"
            " one.parentNode.querySelector('rect').getAttribute('aria-label') === 'assay')"
            ".dispatchEvent(new MouseEvent('click', {bubbles: true}))"
        )
        assert text(tab, ".closer h4") == "assay, slot 6"
        tab.run(
            "[...document.querySelectorAll('.closer .hole')].find((one) =>"
            " one.textContent.startsWith('A1:')).dispatchEvent(new MouseEvent('click'))"
        )
        assert "A1 of assay holds 30 µL" in text(tab, ".chosen h4")
        assert "30 µL given" in text(tab, ".chosen ol")

    def test_a_filter_holds_nothing_and_an_unknown_volume_is_not_used_up(
        self, tab: Browser
    ) -> None:
        press(tab, "End")

        def told(labware: str, well: str) -> str:
            tab.run(
                "[...document.querySelectorAll('.deck .hole')].find((one) => one.parentNode"
                f".querySelector('rect').getAttribute('aria-label') === '{labware}')"
                ".dispatchEvent(new MouseEvent('click', {bubbles: true}))"
            )
            tab.run(
                "[...document.querySelectorAll('.closer .hole')].find((one) =>"
                f" one.textContent.startsWith('{well}:')).dispatchEvent(new MouseEvent('click'))"
            )
            return str(text(tab, ".chosen"))

        assert told("filter plate", "A1").startswith("A1 of filter plate holds 0 µL")
        mixed = told("tubes", "D2")
        assert mixed.startswith("D2 of tubes holds an unknown volume less 100 µL")
        assert mixed.index("from D2 of tubes") < mixed.index("from A1 of"), "most comes first"

    def test_no_name_was_run_as_a_program(self, tab: Browser) -> None:
        assert tab.run("window.hurt ?? null") is None
        assert tab.run("document.images.length") == 0
        assert tab.errors == []
