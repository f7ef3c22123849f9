from opentrons import protocol_api

metadata = {"protocolName": "Coomassie protein quantification"}
requirements = {"robotType": "OT-2", "apiLevel": "2.18"}

STANDARDS_UG_ML = {"A1": 0, "A2": 125, "A3": 250, "A4": 500, "A5": 750, "A6": 1000, "B1": 1500, "B2": 2000}


def run(protocol: protocol_api.ProtocolContext):
    tips_20 = protocol.load_labware("opentrons_96_tiprack_20ul", "10")
    tips_300 = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in ("8", "9")]
    std_rack = protocol.load_labware("opentrons_24_tuberack_generic_2ml_screwcap", "1", label="BSA standards")
    lysates = protocol.load_labware("opentrons_24_tuberack_generic_2ml_screwcap", "2", label="Lysate samples")
    reagents = protocol.load_labware("nest_12_reservoir_15ml", "4")
    assay = protocol.load_labware("corning_96_wellplate_360ul_flat", "5", label="Assay plate")
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips_20])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=tips_300)

    coomassie = reagents["A1"]
    coomassie.load_liquid(protocol.define_liquid("Bradford reagent", "Coomassie G-250 dye", "#0044aa"), 14000)

    bsa_tubes = [std_rack[name] for name in STANDARDS_UG_ML]
    samples = lysates.wells()[:8]

    standard_wells = assay.columns()[0] + assay.columns()[1]  # duplicates, columns 1 and 2
    sample_wells = assay.columns()[2] + assay.columns()[3]  # duplicates, columns 3 and 4

    # 5 uL of protein, a tip per tube
    for i, tube in enumerate(bsa_tubes):
        p20.distribute(5, tube, [standard_wells[i], standard_wells[i + 8]], disposal_volume=1)
    for i, tube in enumerate(samples):
        p20.distribute(5, tube, [sample_wells[i], sample_wells[i + 8]], disposal_volume=1)

    # 250 uL dye into each well, fresh tip each time
    p300.transfer(250, coomassie, standard_wells, mix_after=(3, 150), new_tip="always")
    p300.transfer(250, coomassie, sample_wells, new_tip="always")

    protocol.delay(minutes=5, msg="colour development")
