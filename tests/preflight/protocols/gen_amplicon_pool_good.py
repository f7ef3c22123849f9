# expect: generic pass
metadata = {"apiLevel": "2.13", "protocolName": "Pool amplicons"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    amplicons = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "amplicons")
    tube = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 3)["A1"]
    p = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for well in amplicons.columns()[0]:
        p.transfer(8, well, tube, new_tip="always")
