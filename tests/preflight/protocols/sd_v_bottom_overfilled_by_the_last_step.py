metadata = {"apiLevel": "2.15", "protocolName": "Serial dilution of antibody"}


def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, "dilution plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 3)
    p300 = protocol.load_instrument(
        "p300_single_gen2", "left", [protocol.load_labware("opentrons_96_tiprack_300ul", 4)]
    )
    diluent, antibody_stock = trough["A1"], rack["A1"]
    dilutions = plate.rows()[0][:6]

    p300.distribute(150, diluent, dilutions[1:], disposal_volume=0)
    p300.transfer(170, antibody_stock, dilutions[0])
    for above, below in zip(dilutions, dilutions[1:]):
        p300.transfer(110, above, below, mix_after=(3, 100), new_tip="always")
