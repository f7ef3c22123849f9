# expect: generic pass
"""Bring wells of three plates together in one."""

metadata = {"apiLevel": "2.13", "protocolName": "Rearray"}

# (source slot, source well, destination)
ROWS = [
    ("1", "A3", "A1"),
    ("1", "C7", "B1"),
    ("2", "C7", "C1"),
    ("2", "A1", "D1"),
    ("4", "A1", "E1"),
]


def run(ctx):
    plates = {}
    for slot in ("1", "2", "4", "5"):
        plates[slot] = ctx.load_labware("nest_96_wellplate_200ul_flat", slot)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 6)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    for a, b, c in ROWS:
        p20.pick_up_tip()
        p20.aspirate(10, plates[a][b])
        p20.dispense(10, plates["5"][c])
        p20.drop_tip()
