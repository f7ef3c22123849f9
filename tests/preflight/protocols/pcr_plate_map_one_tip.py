"""qPCR plate set-up driven by a plate map.

Column 1: samples, H12 no-template control.
"""

metadata = {"protocolName": "qPCR assay plate", "apiLevel": "2.13"}
PLATE_MAP = {"A1": "S1", "B1": "S2", "C1": "S3", "G12": "PTC", "H12": "NTC"}
SOURCES = {"S1": "A1", "S2": "A2", "S3": "A3", "PTC": "B1", "NTC": "D6"}
RXN_VOL, DNA_VOL = 20, 5


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", s) for s in ("7", "8")]
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=tips)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_screwcap", "4")
    qplate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", "1")
    mmx = rack["D1"]

    p20.pick_up_tip()
    for well in PLATE_MAP:
        p20.aspirate(RXN_VOL - DNA_VOL, mmx)
        p20.dispense(RXN_VOL - DNA_VOL, qplate[well])
    p20.drop_tip()
    for well, name in PLATE_MAP.items():
        if not p20.has_tip:
            p20.pick_up_tip()
        p20.aspirate(DNA_VOL, rack[SOURCES[name]])
        p20.dispense(DNA_VOL, qplate[well])
        p20.mix(3, 10, qplate[well])
        pass
    p20.drop_tip()
