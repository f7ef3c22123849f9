# expect: pcr pass
"""Screen of four transformants; two further picks gave no colony."""
metadata = {"apiLevel": "2.15"}


def run(ctx):
    block = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "PCR plate")
    tips = [ctx.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (7, 8)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    master_mix = block["A1"]
    colonies = [block[name] for name in ("C1", "C2", "C3", "C4")]
    screened = [plate[name] for name in ("A1", "A2", "A3", "A4")]
    nothing_grew = [plate["A5"], plate["A6"]]
    ntc = plate["A8"]
    for well in [*screened, *nothing_grew, ntc]:
        p20.transfer(16, master_mix, well, new_tip="always")
    for colony, well in zip(colonies, screened):
        p20.transfer(3, colony, well, mix_after=(2, 10), new_tip="always")
    p20.transfer(3, block["D6"], [*nothing_grew, ntc], new_tip="always")
