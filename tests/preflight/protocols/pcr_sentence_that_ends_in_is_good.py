# expect: pcr pass
"""qPCR of six genes. cDNA goes into columns 1 to 3 as it is. Column 4 is the NTC."""

metadata = {"protocolName": "qPCR", "apiLevel": "2.13"}


def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    cdna = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "cDNA")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    master_mix, water = trough["A1"], trough["A2"]
    m20.transfer(15, master_mix, plate.rows()[0][:4], new_tip="once")
    m20.transfer(5, water, plate["A4"])
    for n in range(3):
        m20.transfer(5, cdna.rows()[0][n], plate.rows()[0][n])
