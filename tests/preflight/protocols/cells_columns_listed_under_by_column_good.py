# expect: cell_treatment pass
"""
Compound Q-17 on THP-1 cells, two doses.

THP-1 plate by column
  1-2    untreated, nothing goes in
  3-4    vehicle control
  5-8    Q-17 low dose
  9-12   Q-17 high dose

Trough: A1 vehicle, A2 Q-17 low dose (2x), A3 Q-17 high dose (2x)
"""

metadata = {"apiLevel": "2.14"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in (7, 8)]
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 6)
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)

    def dose(source, columns):
        for column in columns:
            m300.transfer(50, source, column[0].top(-2), new_tip="always")

    dose(trough["A1"], plate.columns()[2:4])
    dose(trough["A2"], plate.columns()[4:8])
    dose(trough["A3"], plate.columns()[8:12])
