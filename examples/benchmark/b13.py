"""IL-6 ELISA calibrator series.

Two-fold, seven points and a zero, made fresh in a deep-well plate and kept there.
"""
from opentrons import protocol_api

metadata = {"protocolName": "IL-6 calibrators", "author": "Immunoassay team", "apiLevel": "2.14"}


class Series:
    """A lane of wells, top calibrator first."""

    def __init__(self, wells, volume):
        self.wells = wells
        self.volume = volume

    def steps(self):
        return list(zip(self.wells, self.wells[1:]))


def run(ctx: protocol_api.ProtocolContext):
    deep = ctx.load_labware("nest_96_wellplate_2ml_deep", 1, label="Calibrators")
    tubes = ctx.load_labware("opentrons_10_tuberack_falcon_4x50ml_6x15ml_conical", 2)
    tips = ctx.load_labware("opentrons_96_tiprack_1000ul", 3)
    p1000 = ctx.load_instrument("p1000_single_gen2", "left", tip_racks=[tips])

    calibrator_diluent = tubes["A3"]
    il6_stock = tubes["A1"]
    calibrator_diluent.load_liquid(ctx.define_liquid("Calibrator diluent", "diluent", "#bbddff"), 40000)
    il6_stock.load_liquid(ctx.define_liquid("IL-6 stock", "1200 pg/mL", "#cc3300"), 5000)

    column = deep.columns_by_name()["1"]
    lane = Series(column[:7], 500)
    zero = column[7]

    # diluent to points 2..7 and to the zero calibrator
    p1000.transfer(500, calibrator_diluent, lane.wells[1:] + [zero], new_tip="once")
    # neat stock is point 1
    p1000.transfer(1000, il6_stock, lane.wells[0])

    for source, target in lane.steps():
        p1000.transfer(lane.volume, source, target, mix_after=(6, 600), new_tip="always")
