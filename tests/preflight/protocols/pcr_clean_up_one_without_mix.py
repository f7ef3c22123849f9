"""Library prep: PCR, bead clean-up, and one template more than there is master mix for."""

metadata = {"apiLevel": "2.13", "protocolName": "PCR and clean-up"}


def run(protocol):
    magdeck = protocol.load_module("magnetic module gen2", 1)
    mag_plate = magdeck.load_labware("nest_96_wellplate_2ml_deep")
    reaction_plate = protocol.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 2, "PCR plate")
    block = protocol.load_labware("opentrons_24_aluminumblock_nest_2ml_screwcap", 3)
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 4)
    m20 = protocol.load_instrument(
        "p20_multi_gen2", "left", tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 5)]
    )
    p20 = protocol.load_instrument(
        "p20_single_gen2",
        "right",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_20ul", 6)],
    )
    pcr_mm = block["A1"]
    beads, te = reservoir["A1"], reservoir["A6"]
    eluates = mag_plate.rows()[0][0]
    pcr_samples = reaction_plate.columns()[0]
    mag_samples = mag_plate.rows()[0][1]
    purified_samples = reaction_plate.rows()[0][2]
    p20.transfer(15, pcr_mm, pcr_samples[:7])
    m20.transfer(5, eluates, pcr_samples[0])
    m20.transfer(20, pcr_samples[0], mag_samples)
    m20.transfer(18, beads, mag_samples)
    magdeck.engage(height_from_base=10)
    m20.transfer(19, mag_samples, reservoir["A12"])
    m20.transfer(19, mag_samples, reservoir["A12"])
    magdeck.disengage()
    m20.transfer(20, te, mag_samples)
    m20.transfer(20, mag_samples, purified_samples)
