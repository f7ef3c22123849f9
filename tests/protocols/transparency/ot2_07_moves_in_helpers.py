"""Dictionaries of methods, recursion and a context manager around each tip."""
import contextlib

metadata = {'apiLevel': '2.7', 'protocolName': 'helpers all the way down'}


@contextlib.contextmanager
def tip(pipette, keep=False):
    pipette.pick_up_tip()
    try:
        yield pipette
    finally:
        pipette.return_tip() if keep else pipette.drop_tip()


def halve(pipette, wells, volume):
    """Recursive dilution along a list of wells."""
    if len(wells) < 2 or volume < 20:
        return 0
    with tip(pipette, keep=len(wells) % 2 == 0) as p:
        p.aspirate(volume, wells[0])
        p.dispense(volume, wells[1])
        p.mix(2, volume / 2, wells[1])
    return 1 + halve(pipette, wells[1:], volume * 0.8)


def run(ctx):
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', 2)
    rack = ctx.load_labware('opentrons_96_tiprack_300ul', 3)
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=[rack], replace=False)
    steps = halve(p300, plate.rows()[3], 100)
    ctx.comment('%d steps, has tip: %s' % (steps, p300.has_tip))
    for line in list(ctx.commands())[-2:]:
        ctx.comment('before: ' + line)
