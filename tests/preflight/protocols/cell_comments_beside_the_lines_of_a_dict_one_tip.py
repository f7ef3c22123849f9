# expect: cell_treatment warn CELL-3
metadata = {"protocolName": "U2OS, two agents alone and together", "apiLevel": "2.15"}

SOLVENT_WELLS = ["B2", "C2", "D2"]
PAIRS = {
    "B4": ("N1", "Z"), "C4": ("N2", "Z"),
    "B5": ("Z", "O1"), "C5": ("Z", "O2"),
    "B6": ("N1", "O1"), "C6": ("N2", "O2"),
}
TUBES = {
    "Z": "A1",                 # vehicle, 0.05 % DMSO in DMEM
    "N1": "B1", "N2": "B2",    # nutlin-3a 30 nM, 300 nM
    "O1": "C1", "O2": "C2",    # olaparib 1 uM, 4 uM
}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "U2OS cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    vehicle_controls = [plate[name] for name in SOLVENT_WELLS]

    for name, codes in PAIRS.items():
        for code in codes:
            p20.pick_up_tip()
            p20.aspirate(8, rack[TUBES[code]])
            p20.dispense(8, plate[name])
            p20.drop_tip()
    p20.pick_up_tip()
    p20.aspirate(8, rack[TUBES["O2"]])
    p20.dispense(8, plate["D5"])
    for well in vehicle_controls:
        p20.aspirate(16, rack[TUBES["Z"]])
        p20.dispense(16, well)
    p20.drop_tip()
