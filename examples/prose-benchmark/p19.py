"""BCA with kit vials by letter; they are dispensed from the first vial to the last."""

metadata = {"apiLevel": "2.13", "protocolName": "BCA, kit standards"}

KIT = [("A", 2000), ("B", 1000), ("C", 500), ("D", 250), ("E", 0)]


def run(protocol):
    vials = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 7, "BSA vials")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 6, "working reagent")
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    vial = {letter: well for (letter, _), well in zip(KIT, vials.wells())}
    standard_wells = plate.rows()[0][:5]

    # standards: row A, column 1 = vial A ... column 5 = vial E (blank)
    p300.pick_up_tip()
    for (letter, conc), well in zip(KIT, standard_wells):
        p300.aspirate(25, vial[letter])
        p300.dispense(25, well)
    p300.drop_tip()

    # working reagent
    p300.transfer(200, trough["A1"], standard_wells, mix_after=(3, 150), new_tip="always")
