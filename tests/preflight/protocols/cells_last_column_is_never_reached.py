# expect: cell_treatment warn CELL-2
"""
Compounds on HepaRG, controls at both edges.

col 1        vehicle control
cols 2-11    compounds, as on the compound plate
col 12       vehicle control
"""

metadata = {"apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HepaRG")
    compounds = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "compound plate")
    vehicle = protocol.load_labware("nest_12_reservoir_15ml", 3)["A1"]
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tips)
    m20.transfer(20, vehicle, cells["A1"])
    for n in range(1, 11):
        m20.transfer(20, compounds.columns()[n][0], cells.columns()[n][0], new_tip="always")
