# expect: cell_treatment pass
"""Vincristine and etoposide on K562 in rows of their own, one tip for each of them."""

requirements = {"robotType": "Flex", "apiLevel": "2.17"}

VINCRISTINE_nM = [0.2, 1, 5, 25]
ETOPOSIDE_uM = [0.1, 0.5, 2.5, 12.5]


def run(protocol):
    k562 = protocol.load_labware("corning_96_wellplate_360ul_flat", "D1", "K562 suspension")
    stocks = protocol.load_labware("nest_96_wellplate_2ml_deep", "D2", "drugs 8x")
    tips = protocol.load_labware("opentrons_flex_96_filtertiprack_200ul", "C1")
    protocol.load_trash_bin("A3")
    p1000 = protocol.load_instrument("flex_1channel_1000", "left", tip_racks=[tips])
    vinc = stocks.columns()[0][:4]
    etop = stocks.columns()[2][:4]
    dmso = stocks["H12"]
    vehicle_wells = k562.columns()[1][:4]

    p1000.transfer(20, dmso, vehicle_wells)
    for row, sources in (("A", vinc), ("C", etop)):
        p1000.pick_up_tip()
        for n, source in enumerate(sources):
            p1000.aspirate(40, source)
            p1000.dispense(20, k562[f"{row}{n + 4}"])
            p1000.dispense(20, k562[f"{chr(ord(row) + 1)}{n + 4}"])
        p1000.drop_tip()
