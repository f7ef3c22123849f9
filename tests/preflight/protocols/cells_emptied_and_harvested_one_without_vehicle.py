# expect: cell_treatment warn CELL-2
"""LPS stimulation of macrophages.

Slot 1  trough: A1 fresh medium, A2 vehicle (PBS), A3 LPS 10 ng/ml, A11 liquid waste
Slot 2  macrophages, 200 ul per well: columns 1-2 vehicle controls,
        columns 3-4 LPS 10 ng/ml
Slot 5  plate for supernatants, empty
"""

metadata = {"apiLevel": "2.14", "protocolName": "LPS stimulation and harvest"}


def run(protocol):
    trough = protocol.load_labware("nest_12_reservoir_15ml", 1, "trough")
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "macrophages")
    harvest = protocol.load_labware("nest_96_wellplate_2ml_deep", 5, "supernatants")
    tips = [protocol.load_labware("opentrons_96_filtertiprack_200ul", s) for s in (4, 7)]
    m300 = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    heads = [column[0] for column in cells.columns()[:4]]

    m300.transfer(150, heads, trough["A11"].top(), new_tip="always")
    m300.transfer(100, trough["A1"], [head.top() for head in heads], new_tip="once")
    for name, columns in {"A2": (1,), "A3": (3, 4)}.items():
        m300.pick_up_tip()
        for number in columns:
            m300.aspirate(50, trough[name])
            m300.dispense(50, cells[f"A{number}"])
        m300.drop_tip()
    m300.transfer(120, heads, harvest.rows()[0][:4], new_tip="always")
