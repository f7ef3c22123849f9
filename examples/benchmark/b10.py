# Bradford micro-assay. Standards run from the blank upwards in triplicate,
# reagent goes in from above so that it can be given with one tip, then every
# well is mixed with a tip of its own.
metadata = {'apiLevel': '2.13', 'protocolName': 'Bradford micro-assay'}


def run(protocol):
    tips20 = protocol.load_labware('opentrons_96_tiprack_20ul', '7')
    tips300 = protocol.load_labware('opentrons_96_tiprack_300ul', '8')
    bsa_strip = protocol.load_labware('opentrons_96_aluminumblock_generic_pcr_strip_200ul', '4', 'BSA standard strip')
    unknowns = protocol.load_labware('opentrons_24_tuberack_nest_1.5ml_snapcap', '5', 'Unknowns')
    reagent_trough = protocol.load_labware('agilent_1_reservoir_290ml', '6', 'Bradford dye')
    plate = protocol.load_labware('corning_96_wellplate_360ul_flat', '1')
    p20 = protocol.load_instrument('p20_single_gen2', 'left', tip_racks=[tips20])
    p300 = protocol.load_instrument('p300_single_gen2', 'right', tip_racks=[tips300])

    dye = reagent_trough.wells()[0]
    # strip: blank (buffer), then 62.5, 125, 250, 500, 1000 ug/mL
    standards = bsa_strip.columns()[0][:6]
    samples = unknowns.wells()[:4]

    layout = plate.rows()
    standard_triplicates = [[layout[r][c] for c in (0, 1, 2)] for r in range(6)]
    sample_triplicates = [[layout[r][c] for c in (3, 4, 5)] for r in range(4)]

    p20.pick_up_tip()
    for standard, wells in zip(standards, standard_triplicates):
        for well in wells:
            p20.aspirate(10, standard)
            p20.dispense(10, well)
    p20.drop_tip()

    for sample, wells in zip(samples, sample_triplicates):
        p20.pick_up_tip()
        for well in wells:
            p20.aspirate(10, sample)
            p20.dispense(10, well)
        p20.drop_tip()

    used = [w for trio in standard_triplicates + sample_triplicates for w in trio]
    p300.distribute(200, dye, [w.top(1) for w in used], disposal_volume=0)
    for well in used:
        p300.pick_up_tip()
        p300.mix(4, 120, well)
        p300.blow_out(well.top())
        p300.drop_tip()
