# expect: cell_treatment fail CELL-1
metadata = {"protocolName": "Combinations on HeLa", "apiLevel": "2.18"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "1")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "HeLa cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3", "compounds")
    extra = [cells["B1"]]
    vehicle = rack["D1"]
    first, second, third = rack["A2"], rack["A3"], rack["A4"]
    vehicle_controls = [cells[name] for name in ("A1", "B1", "C1")]
    backbone_alone = [cells[name] for name in ("A2", "B2", "C2")]
    combined = {first: cells["A3"], second: cells["B3"], third: cells["C3"]}
    for well in vehicle_controls:
        p20.transfer(10, vehicle, well, new_tip="always")
    for well in [*backbone_alone, *combined.values(), *extra]:
        p20.transfer(5, rack["A1"], well, new_tip="always")
    for partner, well in combined.items():
        p20.transfer(5, partner, well, new_tip="always")
