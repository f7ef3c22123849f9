# expect: cell_treatment pass
"""Macrophages with LPS; all tubes share one description in the inventory."""

metadata = {"protocolName": "LPS on THP-1 macrophages", "apiLevel": "2.14"}
TUBES = {"A1": "vehicle (10x)", "A2": "LPS 1 ng/mL", "A3": "LPS 10 ng/mL", "A4": "LPS 100 ng/mL"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "THP-1 cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for spot, name in TUBES.items():
        liquid = protocol.define_liquid(name, "stimulus", "#AA3377")
        rack[spot].load_liquid(liquid, 900)

    vehicle_control = plate.columns()[1][1:7]
    for well in vehicle_control:
        p20.transfer(11, rack["A1"], well, new_tip="always")
    for number, spot in enumerate(("A2", "A3", "A4")):
        for well in plate.columns()[number + 2][1:7]:
            p20.transfer(11, rack[spot], well, new_tip="always")
