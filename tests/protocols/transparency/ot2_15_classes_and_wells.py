from opentrons.protocol_api.labware import Well
from opentrons.types import Point

metadata = {'apiLevel': '2.15'}


class TrackedWell(Well):
    """A well that knows how high its liquid stands."""

    def __init__(self, well, volume):
        super().__init__(well.parent, well._core, well.api_version)
        self.well = well
        self.left = volume

    def down(self, volume):
        self.left = max(0, self.left - volume)
        height = self.left / (3.14159 * (self.diameter / 2) ** 2)
        return self.well.bottom(max(height - 2, 1))


class Hand:
    def __init__(self, ctx, pipette, trash):
        self.ctx, self.pipette, self.trash = ctx, pipette, trash
        self.log = []

    def __getattr__(self, name):
        return getattr(self.pipette, name)

    def give(self, volume, source, target):
        self.pick_up_tip()
        self.aspirate(volume, source.down(volume))
        self.touch_tip(source.well, radius=0.8, v_offset=-5)
        self.dispense(volume, target.top(-3).move(Point(x=1)))
        self.blow_out(self.trash)
        self.drop_tip()
        self.log.append((volume, target.well_name))


def run(ctx):
    temp = ctx.load_module('temperature module gen2', '3')
    cold = temp.load_labware('opentrons_24_aluminumblock_nest_2ml_snapcap')
    temp.set_temperature(8)
    plate = ctx.load_labware('corning_48_wellplate_1.6ml_flat', '1')
    tips = ctx.load_labware('opentrons_96_tiprack_300ul', '2')
    hand = Hand(ctx, ctx.load_instrument('p300_single_gen2', 'left', tip_racks=[tips]), ctx.fixed_trash['A1'])
    enzyme = TrackedWell(cold['A1'], 1500)
    for target in plate.rows()[2]:
        hand.give(55, enzyme, target)
    ctx.comment(str(hand.log))
    temp.deactivate()
