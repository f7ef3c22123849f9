# expect: pcr fail PCR-1
"""qPCR set-up whose author forgot the master mix altogether."""

metadata = {"apiLevel": "2.13", "protocolName": "qPCR set-up"}


def run(protocol):
    p20 = protocol.load_instrument(
        "p20_single_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 1)]
    )
    rack = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_screwcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    master_mix, water = rack["A1"], rack["A2"]
    templates = rack.columns()[3]
    ntc = plate["H12"]
    for template, well in zip(templates, plate.columns()[0]):
        p20.transfer(5, template, well)
    p20.transfer(5, water, ntc)
