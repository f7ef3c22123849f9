"""The trace as the model reads it: short, in order, and nothing left out unsaid."""

from __future__ import annotations

import re
import textwrap

from aegis_ot.preflight.trace import places
from aegis_ot.vocabulary import Dossier, WellRef

from .samples import checked


def dossier(body: str) -> Dossier:
    setup = """
    metadata = {"apiLevel": "2.15"}
    def run(protocol):
        plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
        trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
        racks = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (3, 4)]
        p300 = protocol.load_instrument("p300_single_gen2", "left", racks)
        multi = protocol.load_instrument("p300_multi_gen2", "right", racks)
    """
    text = textwrap.dedent(setup) + textwrap.indent(textwrap.dedent(body), "    ")
    return checked(text)[1]


def wells(names: str, slot: str = "1") -> list[WellRef]:
    return [WellRef(slot, name, "", slot) for name in names.split()]


def test_wells_are_folded_in_order() -> None:
    assert places(wells("A1 B1 C1 D1")) == "1:A1-D1"
    assert places(wells("A1 A2 A3")) == "1:A1-A3"
    assert places(wells("A1 B1 A2 B2")) == "1:A1-B2"
    assert places(wells("A1 A1 A1 B1")) == "1:3×A1,B1"
    assert places(wells("C3 A1") + wells("A1", "2")) == "1:C3,A1,2:A1"
    assert places(wells("A1 A1")) == "1:A1"


def test_a_loop_is_one_line() -> None:
    table = dossier(
        """
        p300.distribute(50, trough["A1"], plate.wells(), disposal_volume=0)
        for well in plate.wells():
            p300.transfer(20, trough["A2"], well, mix_after=(3, 40))
        """
    ).table
    assert len(table) == 2
    assert "give. 50" in table[0]
    assert "96 pick-ups one after the other" in table[1]
    assert "give 20 1:A1-H12; L12 mix 40 1:A1-H12" in table[1]


def test_marks_tell_what_is_touched() -> None:
    (line,) = dossier(
        """
        p300.pick_up_tip()
        p300.aspirate(100, trough["A1"])
        p300.dispense(50, plate["A1"])
        p300.dispense(20, plate["A1"])
        p300.dispense(10, plate["A1"].top())
        p300.touch_tip(plate["A1"])
        p300.drop_tip()
        """
    ).table
    assert "draw 100 2:A1" in line
    assert "give. 50 1:A1" in line
    assert "give 20 1:A1" in line
    assert "give^ 10 1:A1" in line
    assert "touch 1:A1" in line


def test_a_returned_tip_is_marked() -> None:
    table = dossier(
        """
        p300.pick_up_tip(racks[0]["A1"])
        p300.aspirate(10, trough["A1"])
        p300.dispense(10, plate["A1"])
        p300.return_tip()
        p300.pick_up_tip(racks[0]["A1"])
        p300.aspirate(10, trough["A2"])
        p300.dispense(10, plate["A1"])
        p300.drop_tip()
        """
    ).table
    assert ["USED BEFORE" in line for line in table] == [False, True]


def test_channels_are_told() -> None:
    (line,) = dossier("multi.transfer(10, trough['A1'], plate['A3'])").table
    assert line.startswith("tips 1-8 (8 channels at once)")
    assert "1:A3-H3" in line


def test_what_does_not_fit_is_folded_further() -> None:
    body = """
    import random
    order = random.Random(1)
    for number in range(90):
        wells = order.sample(plate.wells(), 9)
        for well in wells:
            p300.pick_up_tip() if not p300.has_tip else None
            p300.aspirate(1 + order.random() * 100, trough["A1"])
            p300.dispense(None, well)
        p300.drop_tip()
    """
    table = dossier(body).table
    assert sum(map(len, table)) < 7000
    assert len(table) < 90
    told = re.finditer(r"tips? [\d,.-]+(?:, (\d+) pick-ups[a-z, ]*)?:", "\n".join(table))
    assert sum(int(found[1] or 1) for found in told) == 90


def test_sessions_with_others_between_them_keep_their_order() -> None:
    """A table folded so far that nobody sees what went where tells a model nothing."""
    body = """
    import random
    order = random.Random(3)
    for target in order.sample(plate.wells(), 96):
        p300.transfer(order.randint(20, 40), trough["A1"], target)
        p300.transfer(order.randint(50, 90), trough["A2"], target)
    """
    water, sample = dossier(body).table
    assert ", 96 pick-ups, others in between: L13 draw 20-40 2:A1; L13 give. 20-40 1:" in water
    assert ", 96 pick-ups, others in between: L14 draw 50-90 2:A2; L14 give 50-90 1:" in sample
    given = [line.rpartition(" 1:")[2].split(",") for line in (water, sample)]
    assert given[0] == given[1]
    assert given[0][:3] == ["G4", "D10", "F9"]
