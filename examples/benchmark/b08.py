from opentrons import protocol_api

metadata = {
    "protocolName": "Antibody titration, 1:3 down the plate",
    "author": "Flow cytometry facility",
    "apiLevel": "2.14",
}


def run(protocol: protocol_api.ProtocolContext):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", label="Titration plate")
    tubes = protocol.load_labware("opentrons_15_tuberack_falcon_15ml_conical", "5")
    racks = [protocol.load_labware("opentrons_96_tiprack_300ul", "4")]
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=racks)

    facs_buffer = protocol.define_liquid("FACS buffer", "diluent, PBS with 2 % FBS", "#aaddff")
    stock = protocol.define_liquid("CD45-PE stock", "antibody at 8 ug/mL", "#ff66cc")
    tubes["A1"].load_liquid(facs_buffer, 10000)
    tubes["C1"].load_liquid(stock, 2000)

    diluent = tubes["A1"]
    antibody_stock = tubes["C1"]
    series = plate.rows_by_name()["B"][:8]

    # well 1 holds neat antibody, all the others buffer
    p300.pick_up_tip()
    for well in series[1:7]:
        p300.aspirate(140, diluent)
        p300.dispense(140, well)
    p300.drop_tip()

    p300.transfer(210, antibody_stock, series[0])

    for concentrated, next_well in zip(series[:-1], series[1:]):
        p300.pick_up_tip()
        p300.aspirate(70, concentrated)
        p300.dispense(70, next_well)
        p300.mix(5, 60, next_well)
        p300.blow_out(next_well.top())
        p300.drop_tip()
