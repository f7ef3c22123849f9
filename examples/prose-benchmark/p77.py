metadata = {"apiLevel": "2.15", "protocolName": "Legionella PCR, five swabs"}


def run(protocol):
    swabs = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    pcr = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, water = tubes["A1"], tubes["A2"]
    targets = pcr.columns()[0][:6]  # A1-E1 swabs, F1 NTC
    extracts = swabs.columns()[0][:5]  # template DNA; the NTC gets water instead

    p20.distribute(15, master_mix, targets)
    for source, target in zip([*extracts, water], targets):
        p20.transfer(5, source, target, new_tip="always", mix_after=(2, 10))
