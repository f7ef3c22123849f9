metadata = {"protocolName": "qPCR class based", "apiLevel": "2.13"}


class Job:
    def __init__(self, name, tube, wells):
        self.name, self.tube, self.wells = name, tube, wells


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 5)
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    p = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    mix, water = tubes["A1"], tubes["A2"]
    jobs = [
        Job("sample 1", tubes["B1"], plate.columns()[0][:3]),
        Job("sample 2", tubes["B2"], plate.columns()[1][:3]),
        Job("NTC", water, plate.columns()[2][:3]),
    ]
    for j in jobs:
        p.transfer(15, mix, j.wells, new_tip="once")
    p.pick_up_tip()
    for w in jobs[2].wells:
        p.transfer(5, water, w, new_tip="never")
    p.drop_tip()
    for j in jobs[:2]:
        p.transfer(5, j.tube, j.wells, new_tip="once")
    p.pick_up_tip()
    for j in jobs[1:]:
        for w in j.wells:
            p.mix(2, 10, w)
    p.drop_tip()
