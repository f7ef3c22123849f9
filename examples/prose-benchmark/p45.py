metadata = {"protocolName": "HeLa dosing", "apiLevel": "2.14"}
LAYOUT = {
    "untreated": ["A1", "B1", "C1"],
    "DMSO": ["A2", "B2", "C2"],
    "1 uM": ["A3", "B3", "C3"],
    "10 uM": ["A4", "B4", "C4"],
}


def run(protocol):
    p = protocol.load_instrument(
        "p20_single_gen2",
        "left",
        tip_racks=[protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)],
    )
    cell_plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "HeLa cells")
    cmpd = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "compounds")
    veh = cmpd["A1"]
    drug_1uM, drug_10uM = cmpd["A2"], cmpd["A3"]
    p.transfer(2, veh, [cell_plate[w] for w in LAYOUT["DMSO"]], new_tip="once")
    p.pick_up_tip()
    for src, key in ((drug_1uM, "1 uM"), (drug_10uM, "10 uM")):
        for w in LAYOUT[key]:
            p.aspirate(2, src)
            p.dispense(2, cell_plate[w])
    p.drop_tip()
