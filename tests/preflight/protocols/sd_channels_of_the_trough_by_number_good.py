# expect: serial_dilution pass SD-4!
"""Ki of a ligand, two-fold from the compound plate's first row.

Trough in slot 2
  channel 1   assay medium (diluent for the compound)
  channel 2   lysis buffer for the end of the day
"""

metadata = {"protocolName": "Ligand, dilution in the plate", "apiLevel": "2.13"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "dilution plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3, "compound stock")
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    wells = plate.rows()[0]

    p300.transfer(100, trough["A1"], wells[:6], new_tip="once")
    p300.transfer(100, trough["A1"], wells[6:], new_tip="once")
    for here, there in zip([rack["A1"], *wells], wells):
        p300.transfer(100, here, there, mix_after=(5, 90), new_tip="always")
