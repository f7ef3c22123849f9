# expect: serial_dilution pass SD-4! SD-3!
"""Calibrators of two hormones; the serum in slot 2 dilutes them."""

metadata = {"apiLevel": "2.14", "protocolName": "Serial dilution of hormone calibrators"}


def run(protocol):
    stocks = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1, "stocks")
    tubes = protocol.load_labware("opentrons_15_tuberack_nest_15ml_conical", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "calibrators")
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 4)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    serum = tubes["A1"]
    serum.load_liquid(protocol.define_liquid("steroid-free serum", "diluent", "#ffee99"), 10000)
    for stock, row in zip(stocks.wells()[:2], plate.rows()[:2]):
        p300.transfer(100, serum, row[1:7], new_tip="once")
        p300.transfer(200, stock, row[0])
        for source, target in zip(row[:6], row[1:7]):
            p300.transfer(100, source, target, mix_after=(5, 120), new_tip="always")
