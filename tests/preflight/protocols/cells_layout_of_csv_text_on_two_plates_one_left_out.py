# expect: cell_treatment fail CELL-2
"""Two replicate plates of PC-3 after one list, as the LIMS writes it."""

metadata = {"protocolName": "Enzalutamide, PC-3", "apiLevel": "2.13"}

LIST = "B2+C2+D2=x B3+C3+D3=y"
KINDS = {"x": "vehicle", "y": "drug"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plates = [
        protocol.load_labware("corning_96_wellplate_360ul_flat", slot, f"PC-3 cells replicate {slot}")
        for slot in (4, 5)
    ]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    sources = {"vehicle": tubes["A1"], "drug": tubes["A2"]}

    layout = {}
    for entry in LIST.split():
        wells, kind = entry.split("=")
        layout[KINDS[kind]] = wells.split("+")

    for plate in plates:
        for content in ("vehicle", "drug"):
            for well in layout[content][content == "vehicle" :]:
                p20.transfer(10, sources[content], plate[well], new_tip="always")
