# expect: pcr fail PCR-4 PCR-6?
metadata = {"protocolName": "ddPCR copy number", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    mix = protocol.load_labware("nest_12_reservoir_15ml", 2, "ddPCR supermix with assay")
    water = protocol.load_labware("nest_12_reservoir_15ml", 3, "PCR water")
    dna = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 4, "gDNA")
    out = protocol.load_labware(
        "biorad_96_wellplate_200ul_pcr", 5, "Plate: 1-2 gDNA, 3 pos. control, 4 NTC"
    )
    control = protocol.load_labware(
        "nest_96_wellplate_100ul_pcr_full_skirt", 6, "positive control DNA"
    )
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    columns = out.rows()[0][:4]
    m20.pick_up_tip()
    for column in columns:
        m20.aspirate(17, mix["A1"])
        m20.dispense(17, column)
    m20.drop_tip()
    m20.transfer(3, dna["A1"], columns[0], new_tip="always")
    m20.transfer(3, dna["A2"], columns[1], new_tip="always")
    m20.transfer(3, control["A1"], columns[2], new_tip="always")
    m20.transfer(3, dna["A3"], columns[3], new_tip="always")
