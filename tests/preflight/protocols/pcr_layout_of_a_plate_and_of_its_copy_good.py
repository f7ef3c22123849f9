# expect: pcr pass PCR-4!
"""16S reactions made in a deep block and stamped into the PCR plate."""

metadata = {"apiLevel": "2.13"}
LAYOUT = {
    "A1": "stool 1", "B1": "stool 2", "C1": "stool 3", "D1": "stool 4",
    "E1": "stool 5", "F1": "stool 6", "G1": "mock community", "H1": "NTC",
}  # fmt: skip


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", s) for s in ("7", "8")]
    block = protocol.load_labware("nest_96_wellplate_2ml_deep", "1", "premix block")
    pcr_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "2", "PCR plate")
    extracts = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3", "stool DNA")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "5", "reagents")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    master_mix, water = rack["D5"], rack["D6"]
    for name in LAYOUT:
        p20.transfer(18, master_mix, block[name], new_tip="always")
    for tube, name in zip(extracts.wells()[:7], LAYOUT):
        p20.transfer(2, tube, block[name], new_tip="always")
    p20.transfer(2, water, block["H1"])
    for name in LAYOUT:
        p20.transfer(19, block[name], pcr_plate[name], new_tip="always")
