# raises: Q1
"""Retries, generators that pipette, a context manager that swallows an error."""
requirements = {"robotType": "Flex", "apiLevel": "2.24"}
metadata = {"protocolName": "j"}
from opentrons.protocol_api import SINGLE, ALL, COLUMN
import contextlib
def chunks(xs, n):
    for i in range(0, len(xs), n):
        yield xs[i:i + n]
class Retry:
    def __init__(self, times): self.times = times
    def __call__(self, f):
        def inner(*a, **k):
            for n in range(self.times):
                try: return f(*a, **k)
                except ValueError as e: err = e
                finally: inner.calls += 1
            raise err
        inner.calls = 0
        return inner
tries = iter([1, 1, 0])
@Retry(5)
def flaky(p, a, b):
    if next(tries): raise ValueError("again")
    p.transfer(40, a, b)
@contextlib.contextmanager
def tip(p, where=None):
    p.pick_up_tip(where) if where else p.pick_up_tip()
    try: yield
    except IndexError: p.blow_out(p.trash_container)
    finally: p.drop_tip()
def run(ctx):
    tips = [ctx.load_labware("opentrons_flex_96_tiprack_200ul", s) for s in ("A1", "B1")]
    plate = ctx.load_labware("nest_96_wellplate_2ml_deep", "D2")
    res = ctx.load_labware("nest_12_reservoir_15ml", "D3")
    ctx.load_trash_bin("A3")
    p = ctx.load_instrument("flex_8channel_1000", "left", tip_racks=tips)
    q = ctx.load_instrument("flex_1channel_1000", "right", tip_racks=tips[1:])
    water = ctx.get_liquid_class("water")
    for pair in chunks(plate.rows()[0][2:6], 2):
        p.transfer_with_liquid_class(water, 30, [res["A1"]] * 2, pair, new_tip="always", group_wells=False)
    q.transfer_with_liquid_class(water, 300, res["A2"], plate["B1"], new_tip="once")
    q.distribute_with_liquid_class(water, 20, res["A3"], plate.wells()[8:14], new_tip="once")
    q.consolidate_with_liquid_class(water, 20, plate.wells()[8:12], plate["H12"], new_tip="always")
    flaky(q, res["A4"], plate["A9"])
    ctx.comment(str(flaky.calls))
    with tip(q):
        q.aspirate(100, res["A1"].bottom(2), rate=0.5)
        q.dispense(50, plate["A7"], push_out=3)
        [][0]
    p.configure_nozzle_layout(style=SINGLE, start="H1", tip_racks=[tips[0]])
    g = (p.transfer(v, res["A5"], w, mix_before=(1, 10)) for v, w in zip((25, 35), plate.columns()[7]))
    try:
        next(g)
    except Exception as e:
        ctx.comment(type(e).__name__)
    list(g)
    def finale():
        try: return q.aspirate(5, plate["Q1"])
        finally: ctx.comment("finale")
    finale()
