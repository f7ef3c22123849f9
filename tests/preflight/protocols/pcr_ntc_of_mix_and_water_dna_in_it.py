# expect: pcr warn PCR-4
"""Genotypes of goats by PCR

The rack in slot 5 has the master mix in A1 and the water in A2. Row D of it holds the DNA of six
goats. On the plate, well H1 gets master mix and water only (NTC).
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    b = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    a = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    pip = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    pip.transfer(15, a["A1"], b.columns()[0][:6] + [b["H1"]])
    pip.transfer(5, a["D6"], b["H1"])
    for n in range(6):
        pip.transfer(5, a.rows()[3][n], b.columns()[0][n])
