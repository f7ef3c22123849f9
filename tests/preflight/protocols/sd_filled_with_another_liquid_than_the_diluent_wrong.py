"""Two-fold series of peroxide for a calibration curve."""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "4")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "1", "dilution plate")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "2", "reagents")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    stock, diluent, catalase = trough["A1"], trough["A2"], trough["A3"]
    series = plate.rows()[0]
    for well in series[1:]:
        p300.transfer(100, catalase, well, new_tip="always")
    p300.transfer(200, stock, series[0])
    for source, target in zip(series, series[1:]):
        p300.transfer(100, source, target, mix_after=(5, 80), new_tip="always")
