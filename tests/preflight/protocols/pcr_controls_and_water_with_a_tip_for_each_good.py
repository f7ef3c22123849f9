# expect: pcr pass PCR-2!
"""Legionella qPCR of shower heads.

Plate: A1-F1 swab DNA, G1 strain Paris, H1 NTC.
"""

metadata = {"apiLevel": "2.13"}
CONTROL_TUBES = {"G1": "D5", "H1": "D6"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", "7")
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "1", "plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "tubes")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix = rack["D1"]
    swab_dna = rack.wells()[:3] + rack.wells()[4:7]
    for well in plate.columns()[0]:
        p20.transfer(15, master_mix, well, new_tip="always")
    for tube, well in zip(swab_dna, plate.columns()[0]):
        p20.transfer(5, tube, well, mix_after=(3, 10), new_tip="always")
    # controls and water
    for name, tube in CONTROL_TUBES.items():
        p20.transfer(5, rack[tube], plate[name].top(), new_tip="always")
    for name in CONTROL_TUBES:
        p20.pick_up_tip()
        p20.mix(3, 10, plate[name])
        p20.drop_tip()
