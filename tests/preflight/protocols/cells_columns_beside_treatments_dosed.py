# expect: cell_treatment fail CELL-1
"""A list of treatments and columns, the first of which is dosed by mistake."""

metadata = {"apiLevel": "2.15", "protocolName": "IL-6 stimulation of HepG2"}
PLATE_LAYOUT = [
    ("vehicle", 1),
    ("IL-6 1 ng/ml", 2),
    ("IL-6 10 ng/ml", 3),
]


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HepG2 cells")
    res = protocol.load_labware("nest_12_reservoir_15ml", 5, "cytokine drugs")
    tips = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (3, 6)]
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=tips)
    for n, (what, column) in enumerate(PLATE_LAYOUT):
        m20.transfer(10, res.wells()[max(n, 1)], plate[f"A{column}"], new_tip="always")
