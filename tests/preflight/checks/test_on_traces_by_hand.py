"""Each check on runs of a few steps, built by hand: what it reports, where, and how surely."""

from __future__ import annotations

import itertools
from dataclasses import replace

import pytest

from aegis_ot.adapters.opentrons.instrumentation import OperationKind
from aegis_ot.preflight.evidence import Evidence, Kind
from aegis_ot.preflight.roles import derive
from aegis_ot.preflight.trace import Contact
from aegis_ot.vocabulary import WellRef
from tests.support.bench import Bench
from tests.support.cases import broken, case_of, doubts, wells

PCR = {
    "template": "source:A1 source:A2",
    "master_mix": "source:C1",
    "water": "source:D1",
    "reaction": "plate:A1 plate:A2",
    "ntc": "plate:H1",
}
HIGH, NEAR, DEEP = 1.0, -7.5, -9.5
"""Over a well of 10 mm that holds 30 µL, a level of 1 mm: above the top, near, in the liquid."""


def transfer(
    bench: Bench,
    source: str,
    target: str,
    volume: float = 10,
    top: float = DEEP,
    fresh: bool = True,
) -> None:
    if fresh:
        bench.pick()
    bench.draw(source, volume)
    bench.give(target, volume, top=top)
    if fresh:
        bench.drop()


# -- carry


@pytest.mark.parametrize(
    ("top", "contact"), [(DEEP, Contact.WET), (NEAR, Contact.NEAR), (-4.0, None), (HIGH, None)]
)
def test_template_on_a_tip_gets_into_an_ntc_by_contact_alone(
    top: float, contact: Contact | None
) -> None:
    bench = Bench()
    bench.load("plate:H1", 20)
    bench.pick()
    transfer(bench, "source:A1", "plate:A1", fresh=False)
    transfer(bench, "source:D1", "plate:H1", top=top, fresh=False)
    bench.drop()
    found = broken(case_of(bench.trace(), "pcr", PCR), "PCR-2")
    assert [one.contact for one in found] == ([] if contact is None else [contact])
    if found:
        assert wells(found) == {"plate:H1"}
        assert [site.line for site in found[0].sites] == [2, 5]


def test_a_wet_contact_behind_a_near_one_counts() -> None:
    bench = Bench()
    bench.load("plate:H1", 20)
    bench.pick()
    transfer(bench, "source:A1", "plate:A1", fresh=False)
    transfer(bench, "source:D1", "plate:H1", top=NEAR, fresh=False)
    bench.mix("plate:H1", 10)
    bench.drop()
    (found,) = broken(case_of(bench.trace(), "pcr", PCR), "PCR-2")
    assert found.contact is Contact.WET
    assert [site.line for site in found.sites] == [2, 6]


def test_a_fresh_tip_carries_nothing() -> None:
    bench = Bench()
    transfer(bench, "source:A1", "plate:A1")
    transfer(bench, "source:D1", "plate:H1")
    assert not broken(case_of(bench.trace(), "pcr", PCR), "PCR-2")


def test_a_returned_tip_carries_what_it_met_before() -> None:
    bench = Bench()
    bench.pick("A1")
    transfer(bench, "source:A1", "plate:A1", fresh=False)
    bench.drop(back="A1")
    bench.pick("A1")
    transfer(bench, "source:D1", "plate:H1", fresh=False)
    assert wells(broken(case_of(bench.trace(), "pcr", PCR), "PCR-2")) == {"plate:H1"}


def test_template_goes_back_into_a_stock_only_by_a_dirty_tip() -> None:
    bench = Bench()
    transfer(bench, "source:C1", "plate:A1")
    bench.pick()
    transfer(bench, "source:A1", "plate:A1", fresh=False)
    transfer(bench, "source:C1", "plate:A2", fresh=False)
    bench.drop()
    assert wells(broken(case_of(bench.trace(), "pcr", PCR), "PCR-5")) == {"source:C1"}


# -- never_receives, receives, uniform_volume


def test_a_measured_volume_of_template_in_an_ntc() -> None:
    bench = Bench()
    transfer(bench, "source:A1", "plate:H1", top=HIGH)
    (found,) = broken(case_of(bench.trace(), "pcr", PCR), "PCR-4")
    assert found.well.name == "H1"
    assert "10 µL" in found.message


def test_a_reaction_without_master_mix() -> None:
    bench = Bench()
    for target in ("plate:A1", "plate:H1"):
        transfer(bench, "source:C1", target)
    transfer(bench, "source:A1", "plate:A2")
    assert wells(broken(case_of(bench.trace(), "pcr", PCR), "PCR-1")) == {"plate:A2"}


def test_what_a_reaction_was_cleaned_up_into_needs_no_master_mix() -> None:
    bench = Bench()
    transfer(bench, "source:C1", "plate:A1")
    transfer(bench, "source:A1", "plate:A1")
    transfer(bench, "plate:A1", "source:E5", 20)
    transfer(bench, "source:E5", "source:F5", 20)
    transfer(bench, "source:D1", "source:E5")
    transfer(bench, "source:E5", "plate:A2")
    case = case_of(bench.trace(), "pcr", {**PCR, "ntc": ""})
    assert not broken(case, "PCR-1")
    assert "plate:A2 is filled from wells like it" in doubts(case, "PCR-1")[0]


def test_a_reaction_that_held_more_before_may_have_held_master_mix() -> None:
    bench = Bench()
    transfer(bench, "source:C1", "plate:A1")
    transfer(bench, "source:D1", "plate:A2", 100)
    transfer(bench, "plate:A2", "source:E5", 150)
    case = case_of(bench.trace(), "pcr", {**PCR, "ntc": ""})
    assert not broken(case, "PCR-1")
    assert "plate:A2 than the run puts there" in doubts(case, "PCR-1")[0]


def test_wells_called_for_the_mix_that_they_get_are_reactions() -> None:
    """``mastermix_wells``: where the mix goes, and the template."""
    listed = "plate:A1 plate:B1 plate:C1 plate:D1 plate:E1"
    roles = {**PCR, "reaction": "", "ntc": "", "master_mix": f"source:C1 {listed}"}
    bench = Bench()
    for target in ("plate:A1", "plate:B1", "plate:C1"):
        transfer(bench, "source:C1", target)
        transfer(bench, "source:A1", target)
    transfer(bench, "source:A2", "plate:D1")  # forgotten
    transfer(bench, "source:D1", "plate:E1")
    case = case_of(bench.trace(), "pcr", roles)
    for assigned in case.roles.by_well.values():
        assigned.evidence = tuple(replace(one, kind=Kind.NAME) for one in assigned.evidence)
    derive(case.roles, case.trace)
    assert {well.ref.name for well in case.wells(("reaction",))} == {"A1", "B1", "C1", "D1"}
    assert {str(well.ref) for well in case.wells(("master_mix",))} == {"source:C1"}
    assert wells(broken(case, "PCR-1")) == {"plate:D1"}


def test_a_control_that_is_drawn_from_still_needs_its_master_mix() -> None:
    bench = Bench()
    transfer(bench, "source:C1", "plate:A1")
    transfer(bench, "source:D1", "plate:H1", 5)
    transfer(bench, "plate:H1", "source:E5", 10)
    bench.pick()
    bench.draw("plate:H1", 10, mixing=True)
    bench.give("plate:H1", 10, mixing=True)
    assert wells(broken(case_of(bench.trace(), "pcr", PCR), "PCR-1")) == {"plate:H1"}


def test_of_cleaned_up_reactions_the_one_without_master_mix_is_told() -> None:
    bench = Bench()
    transfer(bench, "source:C1", "plate:A1")
    for target in ("plate:A1", "plate:A2"):
        transfer(bench, "source:A1", target)
        transfer(bench, target, "source:E5", 5)
    case = case_of(bench.trace(), "pcr", {**PCR, "ntc": ""})
    assert wells(broken(case, "PCR-1")) == {"plate:A2"}


def test_where_no_well_gets_master_mix_it_may_be_there_already() -> None:
    bench = Bench()
    transfer(bench, "source:A1", "plate:A2")
    roles = {role: places for role, places in PCR.items() if role != "master_mix"}
    case = case_of(bench.trace(), "pcr", roles)
    assert not broken(case, "PCR-1")
    assert doubts(case, "PCR-1")


def test_an_uneven_volume_of_master_mix() -> None:
    bench = Bench()
    roles = {**PCR, "reaction": "plate:A1 plate:A2 plate:A3"}
    for target, volume in (("plate:A1", 15.0), ("plate:A2", 15.0), ("plate:A3", 12.0)):
        transfer(bench, "source:C1", target, volume)
    assert wells(broken(case_of(bench.trace(), "pcr", roles), "PCR-6")) == {"plate:A3"}


# -- order, mixing


def test_a_reaction_that_is_shared_out_gets_more_of_all_on_purpose() -> None:
    roles = {**PCR, "reaction": "plate:A1 plate:A2 plate:B1 plate:B2"}
    bench = Bench()
    for row, template in zip("AB", ("source:A1", "source:A2"), strict=True):
        transfer(bench, "source:C1", f"plate:{row}1", 30)
        transfer(bench, template, f"plate:{row}1", 10)
        transfer(bench, f"plate:{row}1", f"plate:{row}2", 20)
    transfer(bench, "source:C1", "plate:H1", 15)
    transfer(bench, "source:D1", "plate:H1", 5)
    assert not broken(case_of(bench.trace(), "pcr", roles), "PCR-6")


def test_dye_before_protein_and_dye_never_mixed() -> None:
    roles = {
        "sample": "source:A1 source:B1",
        "dye": "source:C1",
        "sample_well": "plate:A1 plate:B1",
    }
    bench = Bench()
    transfer(bench, "source:A1", "plate:A1")
    transfer(bench, "source:C1", "plate:A1", 100, HIGH)
    transfer(bench, "source:C1", "plate:B1", 100)
    transfer(bench, "source:B1", "plate:B1")
    messages = {one.well.name: one.message for one in
                broken(case_of(bench.trace(), "bradford", roles), "BRD-4")}  # fmt: skip
    assert "never mixed" in messages["A1"]
    assert "B1" in messages


def test_of_two_reagents_the_last_is_the_dye() -> None:
    """An assay of two reagents: the first alone develops nothing."""
    roles = {"sample": "source:A1", "dye": "source:C1 source:D1", "sample_well": "plate:A1"}
    bench = Bench()
    for source in ("source:C1", "source:A1", "source:D1"):
        transfer(bench, source, "plate:A1")
    found = broken(case_of(bench.trace(), "bradford", roles), "BRD-4")
    assert not [one for one in found if "before" in one.message]


def test_dye_that_no_well_is_mixed_behind_is_left_to_a_shaker() -> None:
    roles = {"sample": "source:A1", "dye": "source:C1", "sample_well": "plate:A1 plate:B1"}
    bench = Bench()
    for target in ("plate:A1", "plate:B1"):
        transfer(bench, "source:A1", target)
        transfer(bench, "source:C1", target, 100)
    found = broken(case_of(bench.trace(), "bradford", roles), "BRD-4")
    assert wells(found) == {"plate:A1", "plate:B1"}
    assert all("by hand" in one.warning for one in found)
    assert len({one.cause for one in found}) == 1  # told once, whatever lines add the dye
    bench.pick()
    for _ in range(3):
        bench.draw("plate:A1", 50, mixing=True)
        bench.give("plate:A1", 50, mixing=True)
    (forgotten,) = broken(case_of(bench.trace(), "bradford", roles), "BRD-4")
    assert (wells([forgotten]), forgotten.warning) == ({"plate:B1"}, "")


def test_standards_fall_in_one_tip_session() -> None:
    roles = {"standard": "source:A1 source:B1"}
    levels = {"source:A1": 100.0, "source:B1": 50.0}
    falling, rising = Bench(), Bench()
    for bench, order in ((falling, "AB"), (rising, "BA")):
        bench.pick()
        for row in order:
            transfer(bench, f"source:{row}1", f"plate:{row}1", fresh=False)
        bench.drop()
    assert wells(broken(case_of(falling.trace(), "bradford", roles, levels), "BRD-1"))
    assert not broken(case_of(rising.trace(), "bradford", roles, levels), "BRD-1")


@pytest.mark.parametrize(("order", "found"), [("AB", {"plate:B1"}), ("BA", set())])
def test_one_tip_doses_from_low_to_high(order: str, found: set[str]) -> None:
    roles = {"drug": "source:A1 source:B1", "treated": "plate:A1 plate:B1"}
    levels = {"source:A1": 100.0, "source:B1": 1.0}
    bench = Bench()
    for row in "AB":
        bench.load(f"plate:{row}1", 100)
    bench.pick()
    for row in order:
        transfer(bench, f"source:{row}1", f"plate:{row}1", fresh=False)
    bench.drop()
    assert wells(broken(case_of(bench.trace(), "cell_treatment", roles, levels), "CELL-4")) == found


def test_a_wet_contact_behind_a_near_one_counts_in_the_order_of_doses() -> None:
    roles = {"drug": "source:A1 source:B1", "treated": "plate:A1 plate:B1"}
    bench = Bench()
    for row in "AB":
        bench.load(f"plate:{row}1", 10)
    bench.pick()
    transfer(bench, "source:A1", "plate:A1", fresh=False)
    transfer(bench, "source:B1", "plate:B1", top=-7.0, fresh=False)
    bench.mix("plate:B1", 10)
    levels = {"source:A1": 100.0, "source:B1": 1.0}
    (found,) = broken(case_of(bench.trace(), "cell_treatment", roles, levels), "CELL-4")
    assert (wells([found]), found.contact) == ({"plate:B1"}, Contact.WET)


@pytest.mark.parametrize(("second", "found"), [(9.0, {"plate:B1"}), (10.0, set())])
def test_more_of_one_drug_is_the_higher_dose(second: float, found: set[str]) -> None:
    roles = {"drug": "source:A1", "treated": "plate:A1 plate:B1"}
    bench = Bench()
    for row in "AB":
        bench.load(f"plate:{row}1", 100)
    bench.pick()
    transfer(bench, "source:A1", "plate:A1", 10.0, fresh=False)
    transfer(bench, "source:A1", "plate:B1", second, fresh=False)
    case = case_of(bench.trace(), "cell_treatment", roles, {"source:A1": 5.0})
    assert wells(broken(case, "CELL-4")) == found


# -- dilution series


SERIES = {"diluent": "source:C1", "stock": "source:A1"}


def dilution(mixed: bool = True, one_tip: bool = True) -> Bench:
    bench = Bench()
    bench.pick()
    for column in range(2, 6):
        bench.draw("source:C1", 100)
        bench.give(f"plate:A{column}", 100, top=HIGH)
    bench.drop()
    transfer(bench, "source:A1", "plate:A1", 150)
    columns = [1, 2, 3, 4, 5]
    if one_tip:
        bench.pick()
    for source, target in itertools.pairwise(columns):
        if not one_tip:
            bench.pick()
        bench.draw(f"plate:A{source}", 50)
        bench.give(f"plate:A{target}", 50)
        if mixed:
            for _ in range(3):
                bench.draw(f"plate:A{target}", 60, mixing=True)
                bench.give(f"plate:A{target}", 60, mixing=True)
        if not one_tip:
            bench.drop()
    return bench


@pytest.mark.parametrize(("shaken", "told"), [("plate", 0), ("lidded", 0), ("source", 1)])
def test_what_no_tip_met_is_shaken_in_the_place_of_a_plate(shaken: str, told: int) -> None:
    """Loaded again, with its lid on, a plate goes by another name."""
    roles = {"sample": "source:A1", "dye": "source:C1", "sample_well": "plate:A1"}
    bench = Bench()
    transfer(bench, "source:A1", "plate:A1")
    transfer(bench, "source:C1", "plate:A1", 100)
    trace = bench.trace()
    trace.shaken.append((1000, frozenset({shaken})))
    assert len(broken(case_of(trace, "bradford", roles), "BRD-4")) == told


def test_a_series_that_is_mixed_with_fresh_tips_is_sound() -> None:
    case = case_of(dilution(one_tip=False).trace(), "serial_dilution", SERIES)
    for rule in ("SD-1", "SD-2", "SD-3", "SD-4", "SD-5"):
        assert not broken(case, rule), rule


def test_one_tip_through_a_mixed_series_is_practice() -> None:
    found = broken(case_of(dilution().trace(), "serial_dilution", SERIES), "SD-5")
    assert wells(found) == {"plate:A3", "plate:A4", "plate:A5"}
    assert all("practice" in one.warning for one in found)


def test_a_series_that_is_not_mixed() -> None:
    case = case_of(dilution(mixed=False).trace(), "serial_dilution", SERIES)
    assert wells(broken(case, "SD-1")) == {"plate:A2", "plate:A3", "plate:A4", "plate:A5"}
    assert all(not one.warning for one in broken(case, "SD-5"))


def test_what_all_wells_of_a_series_get_is_a_component_and_no_stock() -> None:
    """The label goes into the control beside the series too, which is no step of it."""
    series = {**SERIES, "stock": "source:A1 source:B1"}
    labelled = Bench()
    for column in range(1, 7):
        transfer(labelled, "source:C1", f"plate:A{column}", 50, HIGH)
        transfer(labelled, "source:B1", f"plate:A{column}", 20, HIGH)
    transfer(labelled, "source:A1", "plate:A1", 100)
    for column in range(1, 5):
        labelled.pick()
        labelled.draw(f"plate:A{column}", 50)
        labelled.give(f"plate:A{column + 1}", 50)
        for _ in range(3):
            labelled.draw(f"plate:A{column + 1}", 60, mixing=True)
            labelled.give(f"plate:A{column + 1}", 60, mixing=True)
        labelled.drop()
    labelled.pick()
    for _ in range(3):
        labelled.draw("plate:A1", 60, mixing=True)
        labelled.give("plate:A1", 60, mixing=True)
    labelled.drop()
    case = case_of(labelled.trace(), "serial_dilution", series)
    assert not wells(broken(case, "SD-1")) - {"plate:A1"}
    assert not broken(case, "SD-3")


def test_the_ends_of_a_series_that_branches_may_be_mixed_by_hand() -> None:
    bench = Bench()
    for column in range(1, 5):
        transfer(bench, "source:C1", f"plate:A{column}", 100, HIGH)
    transfer(bench, "source:A1", "plate:A1", 20)
    bench.pick()
    for _ in range(3):
        bench.draw("plate:A1", 60, mixing=True)
        bench.give("plate:A1", 60, mixing=True)
    bench.drop()
    for column, volume in ((2, 5.0), (3, 10.0), (4, 20.0)):
        transfer(bench, "plate:A1", f"plate:A{column}", volume)
    found = broken(case_of(bench.trace(), "serial_dilution", SERIES), "SD-1")
    assert wells(found) == {"plate:A2", "plate:A3", "plate:A4"}
    assert all("by hand" in one.warning for one in found)


def test_stock_where_diluent_should_come() -> None:
    bench = Bench()
    for column in range(2, 5):
        transfer(bench, "source:A1" if column == 3 else "source:C1", f"plate:A{column}", 100, HIGH)
    transfer(bench, "source:A1", "plate:A1", 150)
    for column in range(1, 4):
        transfer(bench, f"plate:A{column}", f"plate:A{column + 1}", 50)
    assert wells(broken(case_of(bench.trace(), "serial_dilution", SERIES), "SD-4")) == {"plate:A3"}


# -- generic transfers


def test_one_tip_through_several_sources() -> None:
    roles = {"source": "source:A1 source:B1", "destination": "plate:A1 plate:B1"}
    bench = Bench()
    bench.pick()
    for row in "AB":
        transfer(bench, f"source:{row}1", f"plate:{row}1", fresh=False)
    found = broken(case_of(bench.trace(), "generic", roles), "GEN-1")
    assert wells(found) == {"source:B1", "plate:B1"}


def medium_exchange(fresh: bool) -> Bench:
    bench = Bench()
    for well in ("plate:A1", "plate:B1"):
        bench.pick()
        transfer(bench, well, "waste:A1", 50, top=HIGH, fresh=False)
        if fresh:
            bench.drop()
            bench.pick()
        transfer(bench, "source:A1", well, 50, top=HIGH, fresh=False)
        bench.drop()
    return bench


@pytest.mark.parametrize("kind", ["cell_well", "destination", "sample_well"])
def test_what_was_drawn_off_a_well_gets_into_the_stock_that_refills_it(kind: str) -> None:
    roles = {"stock": "source:A1", kind: "plate:A1 plate:B1"}
    found = broken(case_of(medium_exchange(False).trace(), "generic", roles), "GEN-2")
    assert wells(found) == {"source:A1"}
    assert [[site.line for site in one.sites] for one in found] == [[2, 4], [8, 10]]
    assert {bool(one.warning) for one in found} == {kind == "destination"}
    assert not broken(case_of(medium_exchange(False).trace(), "generic", roles), "GEN-1")
    assert not broken(case_of(medium_exchange(True).trace(), "generic", roles), "GEN-2")


def test_a_mix_in_wells_of_which_nothing_is_said_leaves_the_return_open() -> None:
    bench = Bench()
    bench.pick()
    for well in ("plate:A1", "plate:B1"):
        transfer(bench, "source:A1", well, 50, fresh=False)
        bench.mix(well, 30)
    bench.drop()
    roles = {"stock": "source:A1"}
    (told,) = doubts(case_of(bench.trace(), "generic", roles), "GEN-2")
    assert "held before, and the tip that mixed in it at line 4 enters" in told
    given = {**roles, "destination": "plate:A1 plate:B1"}
    assert not doubts(case_of(bench.trace(), "generic", given), "GEN-2")


@pytest.mark.parametrize("order", ["AB", "BA"])
@pytest.mark.parametrize("left_over", [True, False])
def test_wells_with_rising_numbers_may_be_standards_where_nothing_tells_the_assay(
    order: str, left_over: bool
) -> None:
    bench = Bench()
    bench.pick()
    for row in order:
        transfer(bench, f"source:{row}1", f"plate:{row}1", fresh=False)
    case = case_of(bench.trace(), "generic", {"destination": "plate:A1 plate:B1"})
    case.left_over = left_over
    for row, level in (("A", 100.0), ("B", 1.0)):
        ref = WellRef("source", f"{row}1")
        case.roles.derive(ref, "source")
        case.roles.unread.append(Evidence(Kind.NAME, "STD", (ref,), "", levels=(level,)))
    later = order[1]
    if left_over and order == "BA":
        assert not broken(case, "GEN-1")
        (told, *_) = doubts(case, "GEN-1")
        assert "may hold rising standards, or two samples" in told
    else:
        assert wells(broken(case, "GEN-1")) == {f"source:{later}1", f"plate:{later}1"}


def test_back_into_the_pool_that_the_tip_comes_from() -> None:
    """Two wells are drawn off into one: the film on the tip was of that one."""
    roles = {"destination": "plate:A1 plate:A2 pool:A1"}
    bench = Bench()
    for well in ("plate:A1", "plate:A2", "pool:A1"):
        bench.load(well, 100)
    bench.pick()
    for well in ("plate:A1", "plate:A2"):
        transfer(bench, well, "pool:A1", fresh=False)
    found = broken(case_of(bench.trace(), "generic", roles), "GEN-1")
    assert not [one for one in found if one.sites[0].well.labware == "pool"]


@pytest.mark.parametrize(("second", "practice"), [("plate:A2", True), ("plate:B2", False)])
def test_back_into_a_stock_of_which_all_is_given_the_same(second: str, practice: bool) -> None:
    roles = {
        "source": "source:C1",
        "stock": "source:D1",
        "destination": "plate:A1 plate:A2 plate:B2",
    }
    bench = Bench()
    for target in ("plate:A1", "plate:A2"):
        transfer(bench, "source:C1", target, 30, HIGH)
    bench.pick()
    for target in ("plate:A1", second):
        transfer(bench, "source:D1", target, fresh=False)
    found = broken(case_of(bench.trace(), "generic", roles), "GEN-2")
    assert wells(found) == {"source:D1"}
    assert [bool(one.warning) for one in found] == [practice]


def test_what_is_poured_back_into_a_stock_is_no_trace() -> None:
    """The later well is given that liquid too, but may have it from the stock alone."""
    roles = {"source": "source:C1", "stock": "source:D1", "destination": "plate:A1 plate:A2"}
    bench = Bench()
    transfer(bench, "source:D1", "plate:A1", 30, HIGH)
    transfer(bench, "source:C1", "plate:A1", 30, HIGH)
    transfer(bench, "plate:A1", "source:D1", 20)
    transfer(bench, "source:D1", "plate:A2")
    transfer(bench, "source:C1", "plate:A2", 30)
    found = broken(case_of(bench.trace(), "generic", roles), "GEN-2")
    assert wells(found) == {"source:D1"}
    assert [one.warning for one in found] == [""]


def test_pooling_is_meant() -> None:
    roles = {"source": "source:A1 source:B1", "destination": "plate:A1"}
    bench = Bench()
    bench.pick()
    for row in "AB":
        transfer(bench, f"source:{row}1", "plate:A1", fresh=False)
    assert not broken(case_of(bench.trace(), "generic", roles), "GEN-1")


@pytest.mark.parametrize(("second", "found"), [("source:B1", False), ("plate:B1", True)])
def test_reservoir_wells_that_one_loop_draws_from_are_one_source(second: str, found: bool) -> None:
    """Two channels of one trough, drawn from at one line, each for a well of its own."""
    roles = {"source": f"source:A1 {second}"}
    bench = Bench(troughs=("source",))
    bench.pick()
    for source, target in (("source:A1", "plate:C1"), (second, "plate:D1")):
        bench.line = 10
        bench.draw(source, 10)
        bench.give(target, 10)
    assert bool(broken(case_of(bench.trace(), "generic", roles), "GEN-1")) is found


# -- volumes


def test_beyond_the_brim_is_an_error_below_it_a_warning() -> None:
    """Wells of 200 µL that are 10 mm deep and 6 mm wide hold about 254 µL at the brim."""
    bench = Bench()
    bench.load("source:A1", 1000)
    transfer(bench, "source:A1", "plate:A1", 240)
    transfer(bench, "source:A1", "plate:B1", 260)
    transfer(bench, "source:A1", "plate:B1", 50)
    found = {one.well.name: one for one in
             broken(case_of(bench.trace(), "generic", {}), "GEN-3")}  # fmt: skip
    assert "brim (254.5 µL)" in found["A1"].warning
    assert found["B1"].warning == ""
    assert "is filled to 260 µL at line 7, and to 310 µL later; it holds" in found["B1"].message


def test_what_a_mix_gives_back_to_a_stock_overfills_nothing() -> None:
    """A definition may say less than a trough holds."""
    bench = Bench()
    bench.pick()
    bench.draw("source:A1", 250, mixing=True)
    bench.give("source:A1", 250, mixing=True)
    assert not broken(case_of(bench.trace(), "generic", {}), "GEN-3")


def test_a_mix_that_draws_air_makes_no_liquid() -> None:
    bench = Bench()
    bench.load("source:A1", 120)
    bench.pick()
    bench.draw("source:A1", 150, mixing=True)
    bench.give("source:A1", 150, mixing=True)
    bench.drop()
    for target in ("plate:A1", "plate:B1"):
        transfer(bench, "source:A1", target, 70)
    found = broken(case_of(bench.trace(), "generic", {}), "GEN-3")
    assert [one.message for one in found] == [
        "70 µL are drawn from source:A1 at line 10, of whose declared 120 µL 50 µL are left then."
    ]


def test_air_that_goes_to_the_trash_makes_no_other_well_poorer() -> None:
    bench = Bench()
    bench.load("source:A1", 100)
    bench.load("source:B1", 200)
    bench.pick()
    bench.draw("source:A1", 150)
    bench.give("plate:H1", 150)
    bench.draw("source:B1", 100, mixing=True)
    bench.give("source:B1", 100, mixing=True)
    bench.drop()
    transfer(bench, "source:B1", "plate:A1", 190)
    found = broken(case_of(bench.trace(), "generic", {}), "GEN-3")
    assert wells(found) == {"source:A1"}


def test_air_that_left_for_the_trash_is_not_missed_in_what_goes_back() -> None:
    bench = Bench()
    bench.load("source:A1", 100)
    bench.pick()
    bench.draw("source:A1", 150)
    bench._do(OperationKind.DISPENSE, None, 70, disposal=True)
    bench.give("source:A1", 80)
    bench.drop()
    transfer(bench, "source:A1", "plate:A1", 50)
    found = broken(case_of(bench.trace(), "generic", {}), "GEN-3")
    assert [one.sites[-1].line for one in found] == [2]


def test_a_taste_between_two_fillings_empties_no_well() -> None:
    bench = Bench()
    bench.load("source:A1", 1000)
    bench.load("source:B1", 1000)
    for target in ("A1", "B1", "C1", "D1"):
        transfer(bench, "source:B1", f"plate:{target}", 160, HIGH)
        transfer(bench, "source:A1", f"plate:{target}", 30, HIGH)
    transfer(bench, "plate:D1", "source:H5", 16)
    transfer(bench, "source:A1", "plate:D1", 30, HIGH)
    (found,) = broken(case_of(bench.trace(), "generic", {}), "GEN-3")
    assert (found.well.name, found.warning) == ("D1", "")


def test_neither_a_blow_out_nor_a_wash_that_was_drawn_off_fills_a_well_again() -> None:
    bench = Bench()
    bench.load("source:A1", 1000)
    for target in ("A1", "B1", "C1", "D1"):
        transfer(bench, "source:A1", f"plate:{target}", 205, HIGH)
    bench.pick()
    transfer(bench, "plate:D1", "source:H5", 205, HIGH, fresh=False)
    bench.draw("source:A1", 210)
    bench.give("plate:D1", 205, top=HIGH)
    bench.blow_out("plate:D1")
    found = broken(case_of(bench.trace(), "generic", {}), "GEN-3")
    plate = {one.well.name: one.warning for one in found if one.well.labware == "plate"}
    assert plate.keys() == {"A1", "B1", "C1", "D1"}
    assert all("brim" in warning for warning in plate.values())


@pytest.mark.parametrize(("volume", "spills"), [(240, False), (260, True)])
def test_waste_may_fill_its_well_to_the_brim_and_no_further(volume: float, spills: bool) -> None:
    bench = Bench()
    bench.load("source:A1", 1000)
    transfer(bench, "source:A1", "plate:A1", volume, HIGH)
    case = case_of(bench.trace(), "generic", {})
    case.waste = frozenset({WellRef("plate", "A1")})
    assert [one.warning for one in broken(case, "GEN-3")] == ([""] if spills else [])


def test_filled_twice_what_its_neighbours_get_once() -> None:
    bench = Bench()
    bench.load("source:A1", 1000)
    for target in ("A1", "B1", "C1", "D1"):
        transfer(bench, "source:A1", f"plate:{target}", 105, HIGH)
    transfer(bench, "source:A1", "plate:C1", 105, HIGH)
    (found,) = broken(case_of(bench.trace(), "generic", {}), "GEN-3")
    assert found.well.name == "C1"
    assert not found.warning


@pytest.mark.parametrize("declared", [True, False])
@pytest.mark.parametrize(
    ("drawn", "targets", "warns"),
    [(110, ["plate:A1"], True), (150, ["plate:A1"], False), (60, ["plate:A1", "plate:B1"], False)],
)
def test_a_draw_beyond_what_is_there(
    drawn: float, targets: list[str], warns: bool, declared: bool
) -> None:
    """A well of 100 µL: a little more to leave nothing, far too much, and a stock that runs out.
    What was only declared makes no error.
    """
    bench = Bench()
    if declared:
        bench.load("source:A1", 100)
    else:
        transfer(bench, "source:H1", "source:A1", 100)
    for target in targets:
        transfer(bench, "source:A1", target, drawn)
    (found,) = broken(case_of(bench.trace(), "generic", {}), "GEN-3")
    assert bool(found.warning) is (warns or declared)
    assert ("declared" in found.message) is declared


def test_a_supernatant_is_drawn_with_room_to_spare() -> None:
    bench = Bench()
    bench.load("source:A1", 100)
    bench.pick()
    bench.draw("source:A1", 190)
    bench.drop()
    (found,) = broken(case_of(bench.trace(), "generic", {}), "GEN-3")
    assert "waste" in found.warning


def test_what_was_last_filled_is_told_by_a_filling_and_no_mix() -> None:
    bench = Bench()
    transfer(bench, "source:A1", "plate:A1", volume=50)
    transfer(bench, "plate:A1", "plate:A1", volume=30)
    transfer(bench, "plate:A1", "plate:B1", volume=60)
    (found,) = broken(case_of(bench.trace(), "generic", {}), "GEN-3")
    assert [site.line for site in found.sites] == [3, 10]
