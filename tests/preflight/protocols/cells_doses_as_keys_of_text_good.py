# expect: cell_treatment pass
"""Nocodazole on RPE1: the sheet gives uM and tube; one tip from the lowest up."""

metadata = {"protocolName": "Nocodazole, RPE1", "apiLevel": "2.13"}

SHEET = "2@A1 9@A3 5@A2"


def run(protocol):
    rpe1 = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "RPE1")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    doses = {}
    for entry in SHEET.split():
        um, tube = entry.split("@")
        doses[um] = rack[tube]
    vehicle, vehicle_controls = rack["D6"], rpe1.rows()[0][:3]
    p20.transfer(10, vehicle, vehicle_controls)
    p20.pick_up_tip()
    for row, um in enumerate(sorted(doses, key=float), 1):
        for well in rpe1.rows()[row][:3]:
            p20.transfer(10, doses[um], well, new_tip="never")
    p20.drop_tip()
