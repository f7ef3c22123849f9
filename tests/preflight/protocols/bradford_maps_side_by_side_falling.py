# expect: bradford fail BRD-1
"""Protein in saliva, in duplicate.

Tubes (rack in slot 2)            Plate (slot 3)
----------------------            --------------
A1   saline (blank)               A1 B1
A2   BSA 0.125 mg/mL              A2 B2
A3   BSA 0.5 mg/mL                A3 B3
B1   saliva of donor 1            C1 D1
B2   saliva of donor 2            C2 D2
B3   saliva of donor 3            C3 D3
"""

metadata = {"protocolName": "saliva, Bradford", "apiLevel": "2.13"}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    trough = protocol.load_labware("nest_1_reservoir_195ml", 4, "Bradford reagent")
    t20 = protocol.load_labware("opentrons_96_filtertiprack_20ul", 5)
    t300 = protocol.load_labware("opentrons_96_filtertiprack_200ul", 6)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[t300])

    for row in "AB":
        p20.pick_up_tip()
        for n in (3, 2, 1):
            p20.aspirate(5, rack[f"A{n}"])
            p20.dispense(5, plate[f"{row}{n}"])
        p20.drop_tip()
    for n in (1, 2, 3):
        p20.transfer(5, rack[f"B{n}"], [plate[f"{row}{n}"] for row in "CD"], new_tip="always")
    for column in plate.columns()[:3]:
        p300.transfer(200, trough["A1"], column[:4], mix_after=(3, 100), new_tip="always")
