# expect: cell_treatment pass
metadata = {"protocolName": "Nutlin on HCT116, 24 wells", "apiLevel": "2.13"}

NUTLIN_UM = {"A2": 1, "A3": 5, "A4": 10, "B2": 1, "B3": 5, "B4": 10}
CONTROLS = ["A1", "B1"]  # vehicle controls
STOCKS = {"none": "A1", 1: "C1", 5: "C2", 10: "C3"}  # nutlin 200x in DMSO, A1 = DMSO alone


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", "1")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", "2", "HCT116 cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3")
    for name in CONTROLS:
        p20.transfer(5, rack[STOCKS["none"]], plate[name])
    for name, dose in NUTLIN_UM.items():
        p20.transfer(5, rack[STOCKS[dose]], plate[name])
