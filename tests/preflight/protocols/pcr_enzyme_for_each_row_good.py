# expect: pcr pass
metadata = {"protocolName": "PCR after a digestion", "apiLevel": "2.14"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    reagents = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    pcr_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    digest = protocol.define_liquid("FX", "FX enzyme", "#00FF00")
    polymerase = protocol.define_liquid("PCR master mix", "2x", "#0000FF")
    for row in reagents.rows():
        row[0].load_liquid(digest, 50)
        row[3].load_liquid(polymerase, 100)

    for column in pcr_plate.rows()[0][:3]:
        m20.pick_up_tip()
        m20.aspirate(2, reagents["A1"])
        m20.dispense(2, column)
        m20.aspirate(10, reagents["A4"])
        m20.dispense(10, column)
        m20.drop_tip()
