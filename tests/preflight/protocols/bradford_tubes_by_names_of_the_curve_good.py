# expect: bradford pass
"""Protein of milk. The names in the list of pairs are the keys of the tubes."""

metadata = {"apiLevel": "2.14", "protocolName": "Bradford of milk"}

CALIBRATION = [("K0", 0.0), ("K1", 0.05), ("K2", 0.2), ("K3", 0.6), ("K4", 1.4)]


def run(protocol):
    bsa = protocol.load_labware("opentrons_15_tuberack_falcon_15ml_conical", 3)
    milk = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 6, "milk")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    dye = protocol.load_labware("nest_1_reservoir_195ml", 1, "Bradford reagent")["A1"]
    small = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    standards = {name: bsa.wells()[n] for n, (name, _) in enumerate(CALIBRATION)}
    wells = {name: plate.columns()[7][n] for n, (name, _) in enumerate(CALIBRATION)}

    p20.pick_up_tip()
    for name, _ in CALIBRATION:
        p20.aspirate(8, standards[name])
        p20.dispense(8, wells[name])
    p20.drop_tip()
    for tube, well in zip(milk.columns()[0], plate.columns()[8]):
        p20.transfer(8, tube, well)
    for well in [*wells.values(), *plate.columns()[8][:4]]:
        p300.transfer(200, dye, well, new_tip="always", mix_after=(3, 100))
