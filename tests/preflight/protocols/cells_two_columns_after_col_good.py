# expect: cell_treatment pass
"""Toxins on Vero cells.

col 1       cells alone
col 2, 10   vehicle control (saline)
col 3-9     toxins 1 to 7 from the deep-well block
col 11, 12  empty
"""

metadata = {"apiLevel": "2.16", "protocolName": "Vero toxins"}

SALINE_COLUMNS = (2, 10)


def run(protocol):
    vero = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "Vero cells")
    block = protocol.load_labware("nest_96_wellplate_2ml_deep", 3, "toxins")
    saline = protocol.load_labware("nest_1_reservoir_195ml", 6, "saline (vehicle)")["A1"]
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 1)
    m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])

    m300.pick_up_tip()
    for number in SALINE_COLUMNS:
        m300.aspirate(20, saline)
        m300.dispense(20, vero[f"A{number}"].top())
    m300.drop_tip()
    for number in range(3, 10):
        m300.pick_up_tip()
        m300.aspirate(20, block[f"A{number - 2}"])
        m300.dispense(20, vero[f"A{number}"])
        m300.drop_tip()
