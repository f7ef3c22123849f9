from opentrons import protocol_api

metadata = {"protocolName": "Colony PCR, 24 picks", "apiLevel": "2.14"}
requirements = {"robotType": "OT-2"}


def run(protocol: protocol_api.ProtocolContext):
    pcr_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, label="colony PCR")
    picks_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2, label="colony suspensions")
    reagents = protocol.load_labware("opentrons_24_tuberack_nest_2ml_screwcap", 3, label="reagents")
    tip_racks = [protocol.load_labware("opentrons_96_filtertiprack_20ul", slot) for slot in (5, 6)]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tip_racks)

    master_mix = reagents["A1"]
    water = reagents["A2"]
    master_mix.load_liquid(protocol.define_liquid("2x Taq master mix", "with vector primers", "#22aa22"), 800)
    water.load_liquid(protocol.define_liquid("nuclease-free water", "", "#2222ff"), 1000)
    suspension = protocol.define_liquid("colony template", "one colony in 50 uL water", "#bb7700")
    colonies = picks_plate.wells()[:23]
    for c in colonies:
        c.load_liquid(suspension, 50)

    reactions = pcr_plate.wells()[:23]
    ntc = pcr_plate.wells()[23]

    # negative control
    p20.pick_up_tip()
    p20.aspirate(10, water)
    p20.dispense(10, ntc)
    p20.drop_tip()
    p20.transfer(10, master_mix, ntc, mix_after=(3, 10))

    # one tip per colony: suspension first, then mix
    for colony, reaction in zip(colonies, reactions):
        p20.pick_up_tip()
        p20.aspirate(10, colony)
        p20.dispense(10, reaction)
        p20.aspirate(10, master_mix)
        p20.dispense(10, reaction)
        p20.mix(3, 12, reaction)
        p20.drop_tip()
