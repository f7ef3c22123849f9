# expect: cell_treatment fail CELL-1 CELL-2?
"""Nilotinib on K562 cells, from a plate of ready dilutions. Columns of both by arm."""

metadata = {"apiLevel": "2.14", "protocolName": "K562"}

STOCK_COLUMN = {"vehicle": 4, "nilotinib 10 nM": 5, "nilotinib 100 nM": 6, "nilotinib 1 uM": 7}
ARMS = {
    "vehicle": (2, 11),
    "nilotinib 10 nM": (3, 11),
    "nilotinib 100 nM": (5, 6),
    "nilotinib 1 uM": (7, 8),
}


def run(protocol):
    dilutions = protocol.load_labware("nest_96_wellplate_2ml_deep", 1, "nilotinib dilutions")
    k562 = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "K562 cells")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 6)
    m20 = protocol.load_instrument("p20_multi_gen2", "right", tip_racks=[tips])

    for arm, columns in ARMS.items():
        for column in columns:
            m20.pick_up_tip()
            m20.aspirate(10, dilutions[f"A{STOCK_COLUMN[arm]}"])
            m20.dispense(10, k562[f"A{column}"])
            m20.drop_tip()
