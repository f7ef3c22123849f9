# expect: pcr pass
"""Titre of lentiviral stocks by qPCR.

Deck
    D1  PCR plate
    C1  tube rack with DNase-treated, lysed virus preps: eight preps in A1-A6, B1-B2
    C2  tube rack: A1 LTR master mix; B1 dilution buffer (also goes into the NTC);
        row D, D1-D3: plasmid standards 1e6, 1e5, 1e4 copies/uL
    B1  tips

Plate
    A1-H1   stocks
    B2-D2   standards
    H2      NTC
"""

requirements = {"robotType": "Flex", "apiLevel": "2.19"}
metadata = {"protocolName": "Lentiviral titre, qPCR"}


def run(protocol):
    protocol.load_trash_bin("A3")
    plate = protocol.load_labware("opentrons_96_wellplate_200ul_pcr_full_skirt", "D1", "qPCR plate")
    stocks = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "C1", "virus preps")
    reagents = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "C2", "reagents")
    tips = protocol.load_labware("opentrons_flex_96_filtertiprack_50ul", "B1")
    pipette = protocol.load_instrument("flex_1channel_50", "left", tip_racks=[tips])
    master_mix, buffer = reagents["A1"], reagents["B1"]
    preps = stocks.rows()[0] + stocks.rows()[1][:2]
    standards, ntc = plate.columns()[1][1:4], plate["H2"]

    wells = plate.columns()[0] + standards + [ntc]
    pipette.transfer(15, master_mix, wells, new_tip="once")
    for source, well in zip(preps + reagents.rows()[3][:3], plate.columns()[0] + standards):
        pipette.transfer(5, source, well, mix_after=(2, 10), new_tip="always")
    pipette.transfer(5, buffer, ntc)
