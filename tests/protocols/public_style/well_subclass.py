from opentrons.protocol_api.labware import Well

metadata = {'protocolName': 'Plasma aliquots', 'author': 'biobank', 'apiLevel': '2.13'}


class WellH(Well):
    """A well with a running height."""

    def __init__(self, well, height=5.0, min_height=3.0, volume=0.0):
        super().__init__(well.parent, well._core, well.api_version)
        self.well = well
        self.height = height
        self.min_height = min_height
        self.current = volume
        self.area = 3.14159 * (self.diameter / 2) ** 2

    def height_dec(self, vol):
        self.height = max(self.height - vol / self.area, self.min_height)
        self.current -= vol
        return self.well.bottom(self.height)

    def height_inc(self, vol):
        self.height += vol / self.area
        self.current += vol
        return self.well.bottom(self.height + 5)


def run(ctx):
    primary = ctx.load_labware('opentrons_15_tuberack_nest_15ml_conical', '4')
    aliquots = [ctx.load_labware('opentrons_24_tuberack_nest_0.5ml_screwcap', s) for s in ('5', '6')]
    tips = ctx.load_labware('opentrons_96_filtertiprack_1000ul', '1')
    p1000 = ctx.load_instrument('p1000_single_gen2', 'right', tip_racks=[tips])

    donors = [WellH(t, height=60, volume=5000) for t in primary.wells()[:12]]
    cups = [WellH(t, height=1, min_height=1) for rack in aliquots for t in rack.wells()]
    for i, donor in enumerate(donors):
        p1000.pick_up_tip()
        for cup in cups[i * 4:i * 4 + 4]:
            p1000.aspirate(300, donor.height_dec(300))
            p1000.touch_tip(donor.well, v_offset=-4)
            p1000.dispense(300, cup.height_inc(300))
            p1000.blow_out(cup.well.top(-2))
        p1000.drop_tip()
