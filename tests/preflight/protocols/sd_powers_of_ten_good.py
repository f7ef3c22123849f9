# expect: serial_dilution pass SD-2!
"""Phage titration, ten-fold series in SM buffer.

Strip tubes 1-8 hold the levels 10^-1 ... 10^-8 of the lysate; 90 uL SM buffer each,
10 uL carried from tube to tube.
"""
metadata = {"apiLevel": "2.14", "protocolName": "phage titration"}

LEVELS = ["10^-1", "10^-2", "10^-3", "10^-4", "10^-5", "10^-6", "10^-7", "10^-8"]


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    tips3 = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "titration plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips3])
    sm_buffer = trough["A1"]
    lysate = rack["A1"]
    row = plate.rows()[0][:8]
    at = dict(zip(LEVELS, row))
    p300.transfer(90, sm_buffer, row, new_tip="once")
    p20.pick_up_tip()
    p20.transfer(10, lysate, row[0], mix_after=(5, 18), new_tip="never")
    p20.drop_tip()
    for src, dst in zip(row, row[1:]):
        p20.pick_up_tip()
        p20.aspirate(10, src)
        p20.dispense(10, dst)
        p20.mix(5, 18)
        p20.drop_tip()
