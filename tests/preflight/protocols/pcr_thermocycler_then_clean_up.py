metadata = {"apiLevel": "2.15", "protocolName": "PCR and pooling of amplicons"}


def run(protocol):
    tc = protocol.load_module("thermocyclerModuleV2")
    pcr_plate = tc.load_labware("nest_96_wellplate_100ul_pcr_full_skirt")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    dna = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "gDNA")
    p20 = protocol.load_instrument(
        "p20_single_gen2", "left", [protocol.load_labware("opentrons_96_tiprack_20ul", 3)]
    )
    m20 = protocol.load_instrument(
        "p20_multi_gen2", "right", [protocol.load_labware("opentrons_96_tiprack_20ul", 6)]
    )
    master_mix, pool, nfw = rack["A1"], rack["D6"], rack["A2"]
    reactions, ntc = pcr_plate.columns()[0], pcr_plate["A2"]

    tc.open_lid()
    p20.transfer(20, master_mix, [*reactions, ntc], new_tip="once")
    p20.transfer(5, nfw, ntc)
    m20.transfer(5, dna["A1"], pcr_plate["A1"], mix_after=(3, 10))
    tc.close_lid()
    tc.execute_profile(
        steps=[{"temperature": 95, "hold_time_seconds": 15}, {"temperature": 60, "hold_time_seconds": 30}],
        repetitions=30,
        block_max_volume=25,
    )
    tc.open_lid()
    p20.consolidate(3, reactions, pool)
    p20.pick_up_tip()
    p20.aspirate(5, reactions[0])
    p20.dispense(5, pool)
    p20.aspirate(10, nfw)
    p20.dispense(10, pool)
    p20.drop_tip()
