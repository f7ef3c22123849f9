# expect: cell_treatment pass
"""A compound plate with the controls in its first and last column is stamped onto cells."""

metadata = {"apiLevel": "2.15", "protocolName": "Compound plate to U2OS cells"}
CONTROL_COLS = [1, 12]
CMPD_COLS = range(2, 12)


def run(protocol):
    compound_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2, "compounds")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "U2OS cells")
    res = protocol.load_labware("nest_12_reservoir_15ml", 5, "medium")
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (3, 6)]
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tips)
    for c in [*CMPD_COLS, *CONTROL_COLS]:
        m20.transfer(10, compound_plate[f"A{c}"], cells[f"A{c}"], new_tip="always")
