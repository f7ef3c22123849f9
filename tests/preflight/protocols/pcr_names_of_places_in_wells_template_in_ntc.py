# expect: pcr fail PCR-4
metadata = {"protocolName": "Salmonella screen, places instead of wells", "apiLevel": "2.13"}


def run(ctx):
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix = rack["A1"].bottom(1)
    water = rack["A2"].bottom(1)
    templates = [rack[name].bottom(1) for name in ("B1", "B2", "B3")]
    samples = [plate[name].bottom(0.5) for name in ("A1", "B1", "C1")]
    ntc = plate["H1"].bottom(0.5)
    for place in [*samples, ntc]:
        p20.transfer(15, master_mix, place, new_tip="always")
    for template, sample in zip(templates, samples):
        p20.transfer(5, template, sample, new_tip="always")
    p20.transfer(5, templates[-1], ntc, new_tip="always")
