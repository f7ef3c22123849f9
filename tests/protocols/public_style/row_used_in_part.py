metadata = {"protocolName": "qPCR set-up", "apiLevel": "2.15"}


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2)
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", slot) for slot in (3, 6)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    master_mix, water = rack["A1"], rack["B1"]
    templates = rack.rows()[2][:3]
    samples, ntc = plate.rows()[:2]
    count = len(templates)
    for well in samples[:count] + ntc[:count]:
        p20.transfer(15, master_mix, well)
    for template, well in zip(templates, samples):
        p20.transfer(5, template, well)
    for well in ntc[:count]:
        p20.transfer(5, water, well)
