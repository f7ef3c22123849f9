"""Calls with numbers, texts and places of every kind, right and wrong."""
metadata = {"apiLevel": "2.22"}
from opentrons import types
from decimal import Decimal
from fractions import Fraction
import numpy as np
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "µ-plate\n<b>&")
    res = protocol.load_labware("nest_12_reservoir_15ml", 2)
    p = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    m = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    def go(name, *a, who=p, **k):
        try:
            getattr(who, name)(*a, **k)
            protocol.comment(f"{name} ok {who.has_tip}")
        except Exception as e:
            protocol.comment(f"{name} {type(e).__name__}: {str(e)[:90]}")
    A = plate["A1"]
    go("aspirate", 10, A)
    go("pick_up_tip"); go("pick_up_tip")
    for v in ("50", "fifty", Decimal("12.5"), Fraction(1, 3), np.float64(7.5), np.int32(8), True, None, 0, -5, 1e9, float("nan"), float("inf"), [1]):
        go("aspirate", v, A); go("dispense", v, A); go("mix", 1, v, A); go("air_gap", v)
    for loc in (A.top(), A.bottom(-3), A.center(), types.Location(types.Point(50, 50, 50), None), types.Location(types.Point(50, 50, 50), plate), types.Location(types.Point(50, 50, 50), "A1"), protocol.deck.position_for("5"), plate, "A1", tips["A1"], protocol.fixed_trash, types.Location(A.top().point, A), None, 5):
        go("aspirate", 20, loc); go("dispense", 10, loc); go("blow_out", loc); go("touch_tip", loc); go("move_to", loc)
    go("drop_tip", A); go("pick_up_tip", tips["D4"]); go("return_tip"); go("drop_tip")
    go("pick_up_tip", who=m); go("aspirate", 20, res["A1"], who=m); go("dispense", 20, plate["C1"], who=m); go("dispense", 20, plate["A12"], who=m); go("mix", 2, 20, res["A12"].bottom(1), who=m); go("drop_tip", who=m)
    go("pick_up_tip")
    go("transfer", 700, [A, A], [plate["B1"], plate["B2"]], new_tip="never", carryover=True, mix_after=(1, 20), blow_out=True, blowout_location="destination well")
    go("transfer", 700, A, plate["B1"], new_tip="never", carryover=False)
    go("distribute", [10, 20, 30], A, plate.wells()[20:23], new_tip="never", disposal_volume=0, air_gap=5)
    go("consolidate", 20, plate.columns()[3], A.top(), new_tip="never")
    go("transfer", (10, 100), A, plate.columns()[4], gradient=lambda x: x ** 2, new_tip="never")
    go("transfer", 0, A, plate["G1"], new_tip="never")
    go("aspirate", location=A); go("dispense", rate=0.1); go("dispense"); go("blow_out"); go("touch_tip")
    go("home"); go("reset_tipracks")
    p.well_bottom_clearance.aspirate = -100
    go("aspirate", 20, A)
    p.flow_rate.aspirate = 50; p.default_speed = 100
    go("drop_tip", home_after=False)
