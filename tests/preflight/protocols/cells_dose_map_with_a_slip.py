"""Etoposide in three doses by a typed map of wells, every well with a fresh tip."""

metadata = {"apiLevel": "2.13", "protocolName": "Etoposide on HCT116"}

DOSE_UM = {
    1: ["B2", "C2", "D2", "E2"],
    3: ["B3", "C3", "D3", "E3"],
    10: ["B4", "C4", "D4", "E5"],
}
VEHICLE_CONTROLS = ["B5", "C5", "D5", "E5"]


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HCT116 cells")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "etoposide 10x")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    vehicle = tubes["D6"]
    drug = dict(zip(DOSE_UM, tubes.wells()))

    for name in VEHICLE_CONTROLS:
        p20.transfer(10, vehicle, plate[name], new_tip="always")
    for dose, names in DOSE_UM.items():
        for name in names:
            p20.transfer(10, drug[dose], plate[name], new_tip="always")
