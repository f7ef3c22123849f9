# expect: cell_treatment pass
metadata = {"apiLevel": "2.13", "protocolName": "Cisplatin, HEK293"}

PLAN = [
    {"col": 2, "cond": "vehicle", "src": 0},
    {"col": 3, "cond": "cisplatin", "src": 1},
    {"col": 4, "cond": "cisplatin", "src": 1},
    {"col": 5, "cond": "vehicle", "src": 0},
]


def run(protocol):
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HEK293")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    saline, cisplatin = trough["A1"], trough["A2"]
    liquids = [saline, cisplatin]

    for row in PLAN:
        m20.transfer(10, liquids[row["src"]], cells.columns()[row["col"] - 1][0], new_tip="always")
