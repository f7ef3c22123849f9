# expect: cell_treatment pass
metadata = {"apiLevel": "2.13", "protocolName": "Doxorubicin, four batches"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "H9c2 cells")
    res = protocol.load_labware("nest_12_reservoir_15ml", 2, "3-6 doxorubicin, 1 PBS vehicle")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])

    m20.pick_up_tip()
    for target in ("A1", "A12"):
        m20.aspirate(10, res["A1"])
        m20.dispense(10, plate[target])
    m20.drop_tip()
    for n in (3, 4, 5, 6):
        m20.transfer(10, res.wells()[n - 1], plate[f"A{n}"], new_tip="always")
