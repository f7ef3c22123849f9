from dataclasses import dataclass, field

metadata = {"protocolName": "BCA assay", "apiLevel": "2.15"}


@dataclass(order=True)
class Std:
    ug_ml: float
    tube: object = field(compare=False)

    @property
    def label(self):
        raise RuntimeError


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", s) for s in (1, 4)]
    big = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    res = protocol.load_labware("nest_12_reservoir_15ml", 5)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[big])
    standards = {n: Std(c, rack.wells()[n]) for n, c in enumerate([2000, 1000, 500, 250, 0])}
    p20.pick_up_tip()
    for n, s in standards.items():
        p20.aspirate(10, s.tube)
        p20.dispense(10, plate.columns()[0][n])
    p20.drop_tip()
    samples = rack.rows()[3]
    for n, t in enumerate(samples):
        p20.transfer(10, t, plate.columns()[1][n])
    p300.transfer(
        200,
        res["A1"],
        plate.columns()[0][:5] + plate.columns()[1][:6],
        mix_after=(3, 100),
        new_tip="always",
    )
