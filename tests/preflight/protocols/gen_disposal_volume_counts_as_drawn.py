metadata = {"apiLevel": "2.15", "protocolName": "Aliquots"}


def run(protocol):
    stock = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)["A1"]
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    buffer = protocol.define_liquid("buffer", "", "#aabbcc")
    stock.load_liquid(buffer, 200)
    p300 = protocol.load_instrument(
        "p300_single_gen2", "left", [protocol.load_labware("opentrons_96_tiprack_300ul", 4)]
    )
    p300.distribute(48, stock, plate.columns()[0][:4], disposal_volume=30, blow_out=True)
