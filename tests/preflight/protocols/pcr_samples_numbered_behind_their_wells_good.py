# expect: pcr pass
"""
Two assays, twelve gDNAs E1-E12.

qPCR plate  columns 1-2  HBB:  A1-H1 E1-E8, A2-D2 E9-E12, H2 NTC
            columns 4-5  ACTB: A4-H4 E1-E8, A5-D5 E9-E12, H5 NTC
Tube rack   A1 HBB mix, A2 ACTB mix, A3 water
"""

metadata = {"apiLevel": "2.15"}


def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "qPCR plate")
    gdna = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "gDNA")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "mixes")
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    for tube, first in (("A1", 1), ("A2", 4)):
        samples = plate.wells()[8 * (first - 1) : 8 * (first - 1) + 12]
        ntc = plate[f"H{first + 1}"]
        p20.transfer(16, rack[tube], samples + [ntc])
        p20.transfer(4, rack["A3"], ntc)
        p20.transfer(4, gdna.wells()[:12], samples, mix_after=(2, 10), new_tip="always")
