"""Replaces methods of the pipette while running."""
import types

metadata = {'apiLevel': '2.7', 'author': 'somebody'}


def slow_aspirate(self, volume, well):
    self.move_to(well.top())
    old = self.flow_rate.aspirate
    self.flow_rate.aspirate = old / 4
    self.aspirate(volume, well)
    self.flow_rate.aspirate = old
    return self


def run(ctx):
    tips = ctx.load_labware('opentrons_96_filtertiprack_1000ul', '8')
    tubes = ctx.load_labware('opentrons_10_tuberack_nest_4x50ml_6x15ml_conical', '4')
    block = ctx.load_labware('nest_96_wellplate_2ml_deep', '5')
    p1000 = ctx.load_instrument('p1000_single_gen2', 'left', tip_racks=[tips])

    for name, function in {'slow_aspirate': slow_aspirate}.items():
        setattr(p1000, name, types.MethodType(function, p1000))

    original_pick_up = p1000.pick_up_tip
    used = []

    def counted_pick_up(self, *args, **kwargs):
        used.append(len(used) + 1)
        ctx.comment('tip %d' % used[-1])
        return original_pick_up(*args, **kwargs)

    setattr(p1000, 'pick_up_tip', types.MethodType(counted_pick_up, p1000))

    original_aspirate = p1000.aspirate

    def aspirate_and_wait(self, *args, **kwargs):
        result = original_aspirate(*args, **kwargs)
        ctx.delay(seconds=1)
        return result

    p1000.aspirate = types.MethodType(aspirate_and_wait, p1000)

    for well in block.columns()[0][:4]:
        p1000.pick_up_tip()
        p1000.slow_aspirate(400, tubes['A3'])
        p1000.dispense(400, well)
        p1000.blow_out(well.top(-1))
        p1000.drop_tip()
    p1000.transfer(300, tubes['A4'], block.columns()[1][:3])
    del p1000.aspirate
    del p1000.pick_up_tip
    p1000.transfer(300, tubes['A4'], block.columns()[2][:2], new_tip='always')
    assert used[-1] == 5
