# raises: wrapped
"""Recursion, generators, caches, decorators, context managers, a coroutine, chained errors."""
import sys
from functools import lru_cache, wraps
from contextlib import contextmanager
metadata = {"apiLevel": "2.0"}
def hanoi(n, a, b, c):
    if n == 0:
        return
    yield from hanoi(n - 1, a, c, b)
    yield a, b
    yield from hanoi(n - 1, c, b, a)
@lru_cache(None)
def fib(n):
    return n if n < 2 else fib(n - 1) + fib(n - 2)
def slow_fib(n):
    return n if n < 2 else slow_fib(n - 1) + slow_fib(n - 2)
@contextmanager
def with_tip(p):
    p.pick_up_tip()
    try:
        yield p
    finally:
        p.drop_tip()
def deco(f):
    def inner(*a, **k):
        try:
            return f(*a, **k)
        except ZeroDivisionError as e:
            raise RuntimeError("wrapped") from e
    return inner
@deco
def bad(x):
    return 1 / x
class Base:
    def go(self): return "base"
class Child(Base):
    def go(self): return super().go() + "child"
    @property
    def prop(self):
        """doc"""
        return __class__.__name__
    @staticmethod
    def st(): return 3
def deep(n):
    return 0 if n == 0 else 1 + deep(n - 1)
def only_doc():
    """doc"""
def early(x):
    for i in range(3):
        try:
            if i == x: return i
            continue
        finally:
            if x == 9: break
    else:
        return "else"
    return "broke"
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    protocol.comment(str(list(hanoi(3, 1, 2, 3))) + str(fib(80)) + str(slow_fib(12)) + str(deep(600)))
    protocol.comment(str([Child().go(), Child().prop, Child.st(), only_doc(), only_doc.__doc__, early(1), early(9), early(5), Child.prop.__doc__]))
    with with_tip(p):
        p.aspirate(20, plate["A1"]); p.dispense(20, plate["A2"])
    try:
        bad(0)
    except RuntimeError as e:
        import traceback
        protocol.comment(str([(f.name, f.lineno) for f in traceback.extract_tb(e.__traceback__)]) + repr(e.__cause__) + str([(f.name, f.lineno) for f in traceback.extract_tb(e.__cause__.__traceback__)]))
    g = hanoi(3, 1, 2, 3)
    next(g)
    g.close()
    try:
        p.aspirate(1000, plate["A1"])
    except Exception as e:
        protocol.comment(type(e).__name__)
    async def co():
        return 5
    c = co()
    try: c.send(None)
    except StopIteration as s: protocol.comment(str(s.value))
    p.transfer([20, 30], plate["A1"], [plate["B1"], plate["B2"]], new_tip="once")
    bad(0)
