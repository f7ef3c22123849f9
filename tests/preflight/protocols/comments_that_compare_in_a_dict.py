# expect: cell_treatment pass
metadata = {"protocolName": "Two drugs on HeLa", "apiLevel": "2.18"}


WELLS = {
    "dmso": ["A1", "B1"],  # vehicle control
    "nutlin": ["A2", "B2"],  # vs DMSO
    "olaparib": ["A3", "B3"],  # same vehicle as nutlin
}
TUBES = {"dmso": "A1", "nutlin": "B1", "olaparib": "B2"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "1")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "HeLa cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3", "drugs in DMSO")
    for name, wells in WELLS.items():
        for well in wells:
            p20.transfer(5, rack[TUBES[name]], cells[well], new_tip="always")
