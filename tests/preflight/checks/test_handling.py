"""The rules of handling, on small runs of the real engine: each kind in several guises."""

from __future__ import annotations

import functools
import textwrap

import pytest

from aegis_ot.errors import RehearsalError
from aegis_ot.preflight import Report, Script, check_script, load_rules, record
from aegis_ot.vocabulary import Finding

OT2 = """
metadata = {{"apiLevel": "{level}"}}

def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    small = ctx.load_labware("corning_384_wellplate_112ul_flat", 2)
    trough = ctx.load_labware("nest_12_reservoir_15ml", 3)
    tubes = ctx.load_labware("opentrons_24_tuberack_eppendorf_1.5ml_safelock_snapcap", 4)
    deep = ctx.load_labware("nest_96_wellplate_2ml_deep", 5)
    waste = ctx.load_labware("nest_1_reservoir_195ml", 6, "liquid waste")
    racks = [ctx.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (7, 8)]
    small_rack = ctx.load_labware("opentrons_96_tiprack_20ul", 9)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=racks[:1])
    pip = ctx.load_instrument("{single}", "right", tip_racks=racks[1:] + [small_rack][{cut}:])
"""
FLEX = """
from opentrons.protocol_api import ALL, COLUMN, PARTIAL_COLUMN, ROW, SINGLE

requirements = {{"robotType": "Flex", "apiLevel": "{level}"}}

def run(ctx):
    ctx.load_trash_bin("A3")
    rack = ctx.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = ctx.load_labware("nest_96_wellplate_200ul_flat", "D2")
    trough = ctx.load_labware("nest_12_reservoir_15ml", "D1")
    bath = ctx.load_labware("nest_1_reservoir_195ml", "C1")
    pip = ctx.load_instrument("{pipette}", "left", tip_racks=[rack])
"""


@functools.cache
def checked(text: str) -> Report:
    return check_script(Script(text, "p.py"), load_rules())


def found(report: Report, rule: str) -> list[Finding]:
    return [one for one in report.findings if one.rule == rule]


def body(code: str) -> str:
    return textwrap.indent(textwrap.dedent(code), "    ")


def ot2(code: str, level: str = "2.13", single: str = "p300_single_gen2") -> Report:
    cut = 0 if "p20" in single else 1
    head = OT2.format(level=level, single=single, cut=cut)
    return checked(head.replace("racks[1:] + ", "") + body(code) if cut == 0 else head + body(code))


def flex(code: str, pipette: str = "flex_8channel_1000", level: str = "2.22") -> Report:
    return checked(FLEX.format(level=level, pipette=pipette) + body(code))


def told(report: Report, rule: str) -> str:
    """Severity and message of the one finding of a rule; nothing if there is none."""
    (finding,) = found(report, rule) or [None]
    return "" if finding is None else f"{finding.severity.value}: {finding.message}"


ONE_EACH = "m300.pick_up_tip()\nm300.aspirate(30, trough['A1'])\nm300.{}\nm300.drop_tip()"


@pytest.mark.parametrize("level", ["2.0", "2.13", "2.15", "2.20"])
@pytest.mark.parametrize(
    ("step", "said"),
    [
        ("dispense(30, plate['A2'])", ""),
        (
            "dispense(30, plate['B2'])",
            "error: 1 of 8 tips of the left p300_multi_gen2 (channel H1)",
        ),
        ("dispense(30, small['B1'])", ""),
        (
            "dispense(30, small['C1'])",
            "error: 1 of 8 tips of the left p300_multi_gen2 (channel H1)",
        ),
        ("dispense(30, tubes['A1'])", "error: "),
        ("dispense(30, waste['A1'])", ""),
        (
            "blow_out(plate['H1'])",
            "error: 7 of 8 tips of the left p300_multi_gen2 (channels B1 to H1)",
        ),
    ],
)
def test_eight_tips_stand_over_eight_wells(step: str, said: str, level: str) -> None:
    message = told(ot2(ONE_EACH.format(step), level), "HND-1")
    assert message.startswith(said) if said else not message


def test_the_message_names_the_well_to_write() -> None:
    report = ot2(ONE_EACH.format("dispense(30, plate['D2'])"))
    assert "write A2 there" in told(report, "HND-1")
    assert "at line 17" in told(report, "HND-1")
    assert found(report, "HND-1")[0].wells[0].name == "D2"


def test_a_draw_beside_the_wells_is_one_too() -> None:
    report = ot2(
        """
        m300.pick_up_tip()
        m300.aspirate(30, plate["C1"])
        m300.dispense(30, plate["A2"])
        m300.drop_tip()
        """
    )
    assert told(report, "HND-1").startswith("error: 2 of 8 tips")


def test_tips_that_hold_nothing_and_meet_nothing_are_a_warning() -> None:
    report = ot2(
        """
        m300.pick_up_tip()
        m300.aspirate(30, plate["H1"])
        m300.dispense(30, plate["H2"])
        m300.drop_tip()
        """
    )
    assert {one.severity.value for one in found(report, "HND-1")} == {"warning"}


def test_fewer_tips_than_nozzles_stand_where_they_stand() -> None:
    report = ot2(
        """
        m300.pick_up_tip(racks[0]["G1"])
        m300.aspirate(30, trough["A1"])
        m300.dispense(30, plate["G4"])
        m300.drop_tip()
        """
    )
    assert not told(report, "HND-1")


NOZZLES = """
pip.configure_nozzle_layout(style={style}, tip_racks=[rack])
pip.pick_up_tip()
pip.aspirate(50, {source})
pip.dispense(50, plate["{target}"])
pip.drop_tip()
"""


@pytest.mark.parametrize(
    ("pipette", "style", "source", "target", "better"),
    [
        ("flex_8channel_1000", "PARTIAL_COLUMN, start='H1', end='F1'", "trough['A1']", "B3", "C3"),
        ("flex_8channel_1000", "PARTIAL_COLUMN, start='H1', end='F1'", "trough['A1']", "C3", ""),
        ("flex_8channel_1000", "SINGLE, start='H1'", "trough['A1']", "A3", ""),
        ("flex_96channel_1000", "COLUMN, start='A12'", "trough['A1']", "C3", "A3"),
        ("flex_96channel_1000", "COLUMN, start='A12'", "trough['A1']", "A3", ""),
        ("flex_96channel_1000", "ROW, start='H1'", "bath['A1']", "C2", "C1"),
        ("flex_96channel_1000", "ROW, start='H1'", "bath['A1']", "C1", ""),
    ],
)
def test_the_nozzle_that_leads_goes_to_the_named_well(
    pipette: str, style: str, source: str, target: str, better: str
) -> None:
    code = NOZZLES.format(style=style, source=source, target=target)
    message = told(flex(code, pipette), "HND-1")
    assert bool(message) is bool(better)
    assert f"write {better} there" in message or not better


@pytest.mark.parametrize(
    ("place", "severity"),
    [
        ("plate['A1'].bottom(0.2)", ""),
        ("plate['A1'].bottom(-0.3)", "warning"),
        ("plate['A1'].bottom(-2)", "error"),
        ("plate['A1'].top(-15)", "error"),
    ],
)
@pytest.mark.parametrize(
    "step",
    ["pip.transfer(50, {}, deep['A1'])", "pip.pick_up_tip(); pip.move_to({}); pip.return_tip()"],
)
def test_no_tip_is_sent_below_the_bottom(step: str, place: str, severity: str) -> None:
    message = told(ot2(step.format(place)), "HND-2")
    assert message.startswith(severity) if severity else not message


def test_one_depth_in_many_statements_makes_up_for_a_definition() -> None:
    steps = "\n".join(f"pip.transfer(50, plate['A{n}'].bottom(-2), deep['A1'])" for n in (1, 2, 3))
    assert told(ot2(steps), "HND-2").startswith("warning")


@pytest.mark.parametrize(
    ("single", "step", "said"),
    [
        ("p300_single_gen2", "pip.transfer(50, trough['A1'], plate['A1'], mix_after=(3, 40))", ""),
        ("p300_single_gen2", "pip.transfer(50, trough['A1'], plate['A1'], mix_after=(60, 3))",
         "Write (3, 60) for 3 times 60 µL"),
        ("p300_single_gen2", "pip.pick_up_tip(); pip.mix(150, 5, plate['A1']); pip.drop_tip()",
         "Write (5, 150) for 5 times 150 µL"),
        ("p300_single_gen2", "pip.transfer(4, trough['A1'], plate['A1'])", "made for 20 to 300 µL"),
        ("p300_single_gen2", "pip.transfer(4, plate['A1'], waste['A1'].top())", ""),
        ("p20_single_gen2", "pip.transfer(0.4, trough['A1'], plate['A1'])", "made for 1 to 20 µL"),
        ("p20_single_gen2", "pip.transfer(4, trough['A1'], plate['A1'], mix_after=(15, 10))", ""),
    ],
)  # fmt: skip
def test_volumes_are_what_the_pipette_is_made_for(single: str, step: str, said: str) -> None:
    message = told(ot2(step, single=single), "HND-3")
    assert message.startswith("warning") and said in message if said else not message


@pytest.mark.parametrize("configured", [True, False])
def test_a_flex_pipette_may_be_set_for_little(configured: bool) -> None:
    code = f"""
        tips = ctx.load_labware("opentrons_flex_96_tiprack_50ul", "C2")
        pip = ctx.load_instrument("flex_1channel_50", "right", tip_racks=[tips])
        pip.pick_up_tip()
        {"pip.configure_for_volume(2)" if configured else ""}
        pip.aspirate(2, trough["A1"])
        pip.dispense(2, plate["A1"])
        pip.drop_tip()
    """
    message = told(flex(code), "HND-3")
    assert ("configure_for_volume" in message) is not configured


BY_TABLE = """
for well, volume in zip(deep.rows()[0], (40, 0, 25)):
    pip.pick_up_tip()
    pip.aspirate(volume, trough["A1"])
    pip.dispense(volume, {})
    pip.drop_tip()
"""


@pytest.mark.parametrize(
    ("level", "target", "severity"),
    [
        ("2.0", "well", "error"),
        ("2.9", "well", "error"),
        ("2.13", "well", "error"),
        ("2.13", "waste['A1']", "warning"),
        ("2.16", "well", ""),
        ("2.20", "well", ""),
    ],
)
def test_nothing_written_is_nothing_moved(level: str, target: str, severity: str) -> None:
    report = ot2(BY_TABLE.format(target), level)
    message = told(report, "HND-4")
    assert message.startswith(severity) if severity else not message
    if severity == "error":
        assert "0 µL are written" in message
        assert "gives 300 µL of them to A2 of NEST" in message


@pytest.mark.parametrize(("level", "warned"), [("2.13", True), ("2.16", False)])
def test_a_mix_of_nothing_that_mixes_a_full_tip_is_told(level: str, warned: bool) -> None:
    code = """
        pip.pick_up_tip()
        pip.mix(3, 0, trough["A1"])
        pip.drop_tip()
    """
    message = told(ot2(code, level), "HND-4")
    assert ("mixes a full tip, 300 µL, in" in message) is warned


def test_all_that_is_in_the_tip_for_a_tenth_of_nothing() -> None:
    code = """
        pip.pick_up_tip()
        pip.aspirate(200, trough["A1"])
        for well, volume in zip(deep.rows()[0], (50, 0, 150)):
            pip.dispense(volume, well)
        pip.drop_tip()
    """
    messages = [one.message for one in found(ot2(code, "2.15"), "HND-4")]
    assert "gives it 150 µL" in messages[0]


@pytest.mark.parametrize("level", ["2.0", "2.13", "2.14", "2.16"])
def test_a_dispense_that_is_cut_is_told_and_the_books_stay_right(level: str) -> None:
    code = """
        pip.pick_up_tip()
        for row in range(2):
            pip.aspirate(250, trough["A1"])
            for well in plate.rows()[row][:4]:
                pip.dispense(80, well)
        pip.drop_tip()
    """
    report = ot2(code, level)
    (finding,) = found(report, "HND-4")
    assert finding.severity.value == "error"
    assert "80 µL are written for A4" in finding.message
    assert "holds 10 µL then" in finding.message
    assert {well.name for well in finding.wells} == {"A4", "B4"}


@pytest.mark.parametrize(
    ("code", "severity"),
    [
        ("pip.aspirate(100, trough['A1']); pip.dispense(60, plate['A1']); "
         "pip.dispense(41, plate['A2'])", "warning"),
        ("pip.aspirate(60, trough['A1']); pip.dispense(80, plate['A1'])", "warning"),
        ("pip.aspirate(60, trough['A1']); pip.dispense(60, plate['A1']); "
         "pip.dispense(20, plate['A1'].top())", ""),
        ("pip.aspirate(60, plate['A1']); pip.dispense(300, waste['A1'])", ""),
        ("pip.dispense(80, plate['A1'])", "error"),
    ],
)  # fmt: skip
def test_what_is_cut_matters_as_much_as_it_takes_away(code: str, severity: str) -> None:
    message = told(ot2(f"pip.pick_up_tip(); {code}; pip.drop_tip()"), "HND-4")
    assert message.startswith(severity) if severity else not message


GAP = """
pip.pick_up_tip()
pip.aspirate(80, trough["A1"])
pip.air_gap(20)
pip.dispense({given}, plate["A1"])
{then}
pip.drop_tip()
"""


@pytest.mark.parametrize("level", ["2.9", "2.15", "2.22"])
@pytest.mark.parametrize(
    ("given", "then", "said"),
    [
        (100, "", ""),
        (80, "pip.blow_out(plate['A1'])", ""),
        (80, "", "60 µL of liquid reach it"),
        (100, "pip.aspirate(20, plate['A1'].bottom(2))", "takes them along into the trash"),
        (100, "pip.aspirate(20, plate['A1'].top())", ""),
        (100, "pip.aspirate(20, plate['A1'].bottom(9))", ""),
        (100, "pip.aspirate(80, plate['A1']); pip.dispense(80, plate['B1'])", ""),
    ],
)
def test_an_air_gap_is_air_and_leaves_with_the_liquid(
    given: int, then: str, said: str, level: str
) -> None:
    message = told(ot2(GAP.format(given=given, then=then), level), "HND-4")
    assert message.startswith("warning") and said in message if said else not message


@pytest.mark.parametrize(
    ("code", "wells"),
    [
        ("pip.transfer(50, trough['A1'], plate.rows()[0][:5], new_tip='once')\n"
         "pip.consolidate(30, plate.rows()[0][:7], tubes['A1'])", {"A6", "A7"}),
        ("m300.transfer(50, trough['A1'], plate.rows()[0][:5], new_tip='once')\n"
         "for well in plate.rows()[0][:6]:\n    m300.pick_up_tip(); m300.mix(2, 40, well); "
         "m300.drop_tip()", {f"{row}6" for row in "ABCDEFGH"}),
        ("pip.transfer(50, trough['A1'], plate.rows()[0][:5], new_tip='once')\n"
         "pip.consolidate(30, plate.rows()[0][:5], tubes['A1'])", set()),
        ("pip.transfer(100, trough['A1'], plate.rows()[0][1:8], new_tip='once')\n"
         "pip.transfer(50, plate.rows()[0][:7], plate.rows()[0][1:8], mix_after=(3, 50))", set()),
        ("pip.transfer(50, plate.rows()[0][:5], deep.rows()[0][:5], new_tip='always')", set()),
    ],
)  # fmt: skip
def test_nothing_comes_from_wells_that_were_left_out(code: str, wells: set[str]) -> None:
    findings = found(ot2(code), "HND-5")
    assert {well.name for one in findings for well in one.wells} == wells
    assert {one.severity.value for one in findings} <= {"warning"}


@pytest.mark.parametrize("level", ["2.5", "2.13", "2.20"])
def test_a_tube_holds_no_more_than_its_brim(level: str) -> None:
    report = ot2("pip.transfer(200, tubes['A1'], plate.wells()[:48], new_tip='once')", level)
    message = told(report, "HND-6")
    assert message.startswith("error: 9600 µL are drawn from A1")
    assert not found(report, "GEN-3")


@pytest.mark.parametrize(
    ("name", "severity"), [("Buffer reservoir", "warning"), ("Buffers", "error")]
)
def test_a_plate_s_definition_for_a_reservoir_says_not_what_that_holds(
    name: str, severity: str
) -> None:
    code = f"""
        stand_in = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 10, "{name}")
        for well in plate.rows()[0][:3]:
            m300.transfer(250, stand_in["A1"], well)
    """
    assert told(ot2(code), "HND-6").startswith(severity)


@pytest.mark.parametrize(("height", "severity"), [(40, "warning"), (5, "error")])
def test_a_vessel_that_is_taller_than_its_definition_holds_more(height: int, severity: str) -> None:
    code = f"""
        for _ in range(3):
            pip.transfer(100, small["A1"], small["P24"].top({height}))
    """
    assert told(ot2(code), "HND-6").startswith(severity)


def test_one_definition_that_does_not_fit_is_told_once() -> None:
    code = """
        for tube in ("A1", "A2", "A3"):
            pip.transfer(200, small[tube], small["P24"].top(40))
    """
    assert len(found(ot2(code), "HND-6")) == 1


@pytest.mark.parametrize(("targets", "severity"), [(1, "warning"), (2, "error")])
def test_what_is_moved_on_as_a_whole_may_be_swept_up(targets: int, severity: str) -> None:
    code = f"""
        small["A1"].load_liquid(ctx.define_liquid("sample", "", "#f00"), 10)
        pip.transfer(70, trough["A1"], small["A1"])
        pip.transfer(70, small["A1"], plate["A1"])
        pip.transfer(100, small["A1"], plate.wells()[{targets} - 1])
    """
    assert told(ot2(code, "2.15"), "HND-6").startswith(severity)


def test_what_is_refilled_suffices() -> None:
    code = """
        pip.transfer(200, tubes["A1"], plate.wells()[:7], new_tip="once")
        {}
        pip.transfer(200, tubes["A1"], plate.wells()[7:14], new_tip="once")
    """
    assert told(ot2(code.format("")), "HND-6")
    assert not told(ot2(code.format("ctx.pause('Refill the tube')")), "HND-6")
    refill = "pip.transfer(280, deep['A1'], [tubes['A1'].top()] * 5, new_tip='once')"
    assert not told(ot2(code.format(refill)), "HND-6")


@pytest.mark.parametrize(("declared", "severity"), [(500, "warning"), (1500, "warning")])
def test_beyond_what_is_declared_warns_beyond_the_brim_errs(declared: int, severity: str) -> None:
    load = f"""
        liquid = ctx.define_liquid("buffer", "", "#00f")
        tubes["A1"].load_liquid(liquid, {declared})
    """
    within = ot2(load + "    pip.transfer(200, tubes['A1'], plate.wells()[:8])\n", "2.15")
    assert told(within, "GEN-3").startswith(severity)
    assert "declared" in told(within, "GEN-3")
    beyond = ot2(load + "    pip.transfer(200, tubes['A1'], plate.wells()[:16])\n", "2.15")
    assert told(beyond, "HND-6").startswith("error")
    assert not found(beyond, "GEN-3")


def test_a_filter_plate_holds_nothing() -> None:
    code = """
        target = ctx.load_labware("corning_96_wellplate_360ul_flat", 10, "{}")
        for _ in range(3):
            pip.transfer(250, trough["A1"], target["A1"].top(), new_tip="once")
    """
    assert told(ot2(code.format("assay plate")), "GEN-3").startswith("error")
    assert not told(ot2(code.format("filter plate on vacuum")), "GEN-3")
    assert not told(ot2(code.format("Vacuum rack, GeneJet columns")), "GEN-3")


@pytest.mark.parametrize(
    ("racks", "layout", "said"),
    [
        ("tip_racks=[rack]", "pip.configure_nozzle_layout(style=SINGLE, start='H1')",
         "configure_nozzle_layout at line 13 names none"),
        ("tip_racks=[]", "pass", "none was given"),
    ],
)  # fmt: skip
def test_a_pipette_without_racks_is_told_as_that(racks: str, layout: str, said: str) -> None:
    text = FLEX.format(level="2.22", pipette="flex_8channel_1000").replace(
        "tip_racks=[rack]", racks
    )
    with pytest.raises(RehearsalError, match=f"the pipette has no tip rack: {said}"):
        record(Script(text + body(f"{layout}\npip.pick_up_tip()"), "p.py"))


FILTERS = """
filters = ctx.load_labware("opentrons_96_filtertiprack_200ul", 10)
pip.tip_racks = [filters]
"""


@pytest.mark.parametrize("level", ["2.13", "2.20"])
@pytest.mark.parametrize(
    ("call", "left_out"),
    [
        (
            "distribute(190, trough['A1'], plate.rows()[0][:6])",
            ["A1", "A2", "A3", "A4", "A5", "A6"],
        ),
        ("distribute([50, 60, 190, 40], trough['A1'], plate.rows()[0][:4])", ["A3", "A4"]),
        ("consolidate([50, 250, 60], trough.wells()[:3], deep['A1'])", ["A2", "A3"]),
        ("distribute([90, 0, 60], trough['A1'], [w.top(-1) for w in plate.rows()[0][:3]])", []),
        ("distribute(60, trough['A1'], plate.columns()[0])", []),
        ("consolidate(50, trough.wells()[:3], deep['A1'])", []),
    ],
)
def test_a_call_that_ends_without_a_word_is_told(
    call: str, left_out: list[str], level: str
) -> None:
    report = ot2(f"{FILTERS}\npip.{call}", level)
    findings = found(report, "HND-4")
    assert [well.name for one in findings for well in one.wells] == left_out
    assert all("ends without a word" in one.message for one in findings)


def test_eight_channels_reach_the_whole_columns_that_are_named() -> None:
    assert not found(ot2("m300.distribute(40, trough['A1'], plate.columns()[:3])"), "HND-4")


@pytest.mark.parametrize(("label", "severity"), [("half loaded tips", ""), ("tips", "warning")])
def test_every_other_tip_may_be_left_out_of_the_rack(label: str, severity: str) -> None:
    report = ot2(
        f"""
        rack = ctx.load_labware("opentrons_96_tiprack_300ul", 10, "{label}")
        m300.tip_racks = [rack]
        culture = ctx.load_labware("corning_24_wellplate_3.4ml_flat", 11)
        for n in (1, 2):
            for source, well in ((f"A{{n}}", f"A{{n}}"), (f"A{{n + 2}}", f"B{{n}}")):
                m300.pick_up_tip()
                m300.aspirate(50, culture[source])
                m300.dispense(50, plate[well])
                m300.drop_tip()
        """
    )
    on_the_plate = [one for one in found(report, "HND-1") if one.wells[0].slot == "1"]
    assert {one.severity.value for one in on_the_plate} == {severity} - {""}
    assert severity or not found(report, "HND-1")


@pytest.mark.parametrize(
    ("pause", "accused"),
    [
        ("Take the tips out of rows B to H of the rack", False),
        ("Remove all tips but those of row A, then resume", False),
        ("Remove the foil", True),
        ("Take the plate out and check that the tips are seated", True),
    ],
)
def test_tips_that_a_pause_asks_to_take_out_may_stand_over_nothing(
    pause: str, accused: bool
) -> None:
    report = ot2(
        f"""
        ctx.pause("{pause}")
        m300.pick_up_tip()
        m300.aspirate(50, trough["A1"])
        m300.dispense(50, plate["B1"])
        m300.drop_tip()
        """
    )
    assert bool(found(report, "HND-1")) is accused
    assert ("HND-1" in {one.rule for one in report.undecided}) is not accused


@pytest.mark.parametrize(("pause", "accused"), [("Remove the used tips", False), ("Go on", True)])
def test_returned_tips_that_a_pause_asks_to_take_out_are_gone(pause: str, accused: bool) -> None:
    report = ot2(
        f"""
        for name in ("A1", "A2"):
            deep[name].load_liquid(ctx.define_liquid(f"Sample {{name}}", "", "#fff"), 900)
        pip.pick_up_tip(racks[1]["A1"])
        pip.transfer(50, deep["A1"], plate["A1"], new_tip="never")
        pip.return_tip()
        ctx.pause("{pause}")
        pip.reset_tipracks()
        pip.pick_up_tip(racks[1]["A1"])
        pip.transfer(50, deep["A2"], plate["A2"], new_tip="never")
        pip.drop_tip()
        """,
        "2.14",
    )
    assert bool(found(report, "GEN-1")) is accused


@pytest.mark.parametrize(("declared", "open_"), [(200, True), (196, True), (300, False)])
def test_what_the_run_makes_may_be_declared_beforehand(declared: int, open_: bool) -> None:
    report = ot2(
        f"""
        made = ctx.define_liquid("Reaction", "", "#fff")
        plate["A1"].load_liquid(made, {declared})
        pip.transfer(200, deep["A1"], plate["A1"])
        """,
        "2.14",
    )
    assert bool(found(report, "GEN-3")) is not open_
    assert ("GEN-3" in {one.rule for one in report.undecided}) is open_


@pytest.mark.parametrize(
    ("mix", "severity"), [("mix(2, 50)", "warning"), ("mix(2, 50, plate['B1'])", "error")]
)
def test_an_empty_tip_that_mixes_next_may_bring_what_clings_to_it(mix: str, severity: str) -> None:
    report = ot2(
        f"""
        pip.pick_up_tip()
        pip.dispense(50, plate["A1"])
        pip.{mix}
        pip.drop_tip()
        """,
        "2.13",
    )
    assert [one.severity.value for one in found(report, "HND-4")] == [severity]


def test_a_mix_of_nothing_is_not_inexact() -> None:
    code = "pip.pick_up_tip()\npip.mix(2, {}, plate['A1'])\npip.drop_tip()"
    assert not found(ot2(code.format(0), "2.22"), "HND-3")
    assert found(ot2(code.format(5), "2.22"), "HND-3")
