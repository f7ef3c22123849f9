# expect: serial_dilution pass
"""MIC of two antibiotics on a plate each, two-fold, broth from a trough for each plate."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    plates = {
        "cefepime": protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "CEF"),
        "colistin": protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "COL"),
    }
    trough = protocol.load_labware("nest_12_reservoir_15ml", 4)
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in (5, 6, 8)]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    broth = {"cefepime": trough["A1"], "colistin": trough["A5"]}
    antibiotic = {"cefepime": trough["A2"], "colistin": trough["A3"]}
    for name, plate in plates.items():
        tops = plate.rows()[0]
        m300.transfer(100, broth[name], tops[1:10], new_tip="once")
        m300.transfer(200, antibiotic[name], tops[0])
        for one, other in zip(tops[:9], tops[1:10]):
            m300.transfer(100, one, other, mix_after=(6, 80), new_tip="always")
