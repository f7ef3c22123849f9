# expect: pcr pass
metadata = {"protocolName": "Lysis and PCR", "apiLevel": "2.14"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (1, 4)]
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    swabs = protocol.load_labware("nest_96_wellplate_2ml_deep", 6, "swabs")
    lysis_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "lysis plate")
    pcr_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3, "PCR plate")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    samples = protocol.define_liquid("samples", "lysates, later", "#00FF00")
    enzyme = protocol.define_liquid("lysis enzyme", "in its buffer", "#FF0000")
    polymerase = protocol.define_liquid("PCR master mix", "2x", "#0000FF")
    rack["A1"].load_liquid(enzyme, 500)
    rack["A2"].load_liquid(polymerase, 500)
    for well in lysis_plate.wells()[:6]:
        well.load_liquid(samples, 1)

    p20.transfer(15, rack["A1"], lysis_plate.wells()[:5], new_tip="always")
    p20.transfer(10, rack["A2"], pcr_plate.wells()[:6], new_tip="once")
    p20.transfer(15, swabs.wells()[:6], lysis_plate.wells()[:6], new_tip="always")
    p20.transfer(5, lysis_plate.wells()[:6], pcr_plate.wells()[:6], new_tip="always")
