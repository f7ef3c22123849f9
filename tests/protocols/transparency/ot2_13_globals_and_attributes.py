"""Pipettes in module globals, attributes of the protocol's own on contexts, pipettes and wells."""
metadata = {"apiLevel": "2.13"}

p300 = None
plate = None


def distribute_all():
    for well in plate.columns()[1][:3]:
        p300.transfer(p300.my_volume, plate["A1"], well)
        well.filled = getattr(well, "filled", 0) + p300.my_volume


def run(protocol):
    global p300, plate
    protocol.my_notes = []
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    p300.my_volume = 40
    p300.tips_left = 96
    plate.purpose = "assay"
    distribute_all()
    p300.tips_left -= 3
    protocol.my_notes.append(f"{plate.purpose} {p300.tips_left}")
    protocol.comment(protocol.my_notes[0])
