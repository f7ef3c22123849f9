"""Two peptides, one plate each.

Trough:
    A1  assay buffer
    A2  peptide A, 20 uM
    A3  peptide B, 20 uM
"""

metadata = {"protocolName": "peptide titration", "apiLevel": "2.14"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in (4, 5, 6, 7)]
    trough = protocol.load_labware("nest_12_reservoir_15ml", 1, "trough")
    plates = [protocol.load_labware("corning_96_wellplate_360ul_flat", s) for s in (2, 3)]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)

    def build(plate, diluent, peptide):
        cols = plate.rows()[0][:8]
        m300.distribute(80, diluent, cols[1:], disposal_volume=0)
        m300.transfer(160, peptide, cols[0])
        for high, low in zip(cols, cols[1:]):
            m300.transfer(80, high, low, mix_after=(5, 100), new_tip="always")

    build(plates[0], diluent=trough["A1"], peptide=trough["A2"])
    build(plates[1], diluent=trough["A1"], peptide=trough["A3"])
