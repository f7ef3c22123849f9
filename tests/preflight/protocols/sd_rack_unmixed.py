# expect: serial_dilution fail SD-1
"""1:10 steps through a rack, row after row. The tubes hold 900 µL of water each, put in by hand;
only the tubes of the last, 1:2 steps are filled here."""

metadata = {"apiLevel": "2.13", "protocolName": "RNA dilution series for qPCR standards"}


def run(protocol):
    racks = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (1, 4)]
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 3)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=racks)
    water, control = tubes["D6"], tubes["A1"]
    names = ["A1", "A2", "A3", "A4", "A5", "A6", "B1", "B2", "B3"]
    std_wells = [rack[name] for name in names]
    low_wells = [rack[name] for name in ("D1", "D2", "D3")]
    p.transfer(100, control, std_wells[0], mix_after=(3, 200))
    for one, other in zip(std_wells, std_wells[1:]):
        p.transfer(100, one, other, mix_after=(3, 200), new_tip="always")
    p.transfer(300, water, low_wells, new_tip="once")
    chain = [std_wells[-1], *low_wells]
    for one, other in zip(chain, chain[1:]):
        p.transfer(300, one, other, new_tip="always")
