"""Subclasses of Well, list and type, a method added to the class, operators, a reset rack."""
metadata = {"apiLevel": "2.16"}
requirements = {"robotType": "OT-2"}
from opentrons.protocol_api import InstrumentContext, Well, Labware
from opentrons import types
from collections import OrderedDict, defaultdict, deque, ChainMap
from dataclasses import dataclass, field
from enum import Enum
import itertools, functools, operator
class MyWell(Well):
    def __init__(self, well):
        self.__dict__.update(vars(well))
        self.height = 3
    def at(self): return self.bottom(self.height)
    def __getattr__(self, name):
        if name.startswith("__"): raise AttributeError(name)
        raise RuntimeError("no attribute " + name)
    __slots__ = ()
class Kind(Enum):
    A = 1
@dataclass
class Step:
    source: object
    dest: object
    volume: float = 10
    kind: Kind = Kind.A
class Plan(list):
    def __iter__(self):
        return iter(sorted(list.__iter__(self), key=lambda s: s.volume))
class Track(type):
    made = []
    def __call__(cls, *a, **k):
        x = super().__call__(*a, **k); Track.made.append(type(x).__name__); return x
class Pipe(metaclass=Track):
    def __init__(self, p): self.p = p
    def __enter__(self): self.p.pick_up_tip(); return self
    def __exit__(self, *e): self.p.drop_tip(); return e[0] is ZeroDivisionError
    def __getattr__(self, n): return getattr(self.p, n)
    def __matmul__(self, step):
        self.aspirate(step.volume, step.source); self.dispense(step.volume, step.dest)
        return self
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    InstrumentContext.shake = lambda self, n: [self.mix(n, 20) for _ in range(1)]
    try:
        w = MyWell(plate["A1"])
        plan = Plan(Step(w.at(), d, v) for d, v in zip(plate.columns()[1], itertools.cycle([30, 20])))
        with Pipe(p) as pipe:
            functools.reduce(operator.matmul, plan, pipe)
            p.shake(2)
            1 / 0
        for name, value in {"a": p, p: "a"}.items():
            protocol.comment(str(type(value).__name__))
        protocol.comment(str(Track.made) + str(p == p) + str(isinstance(p, InstrumentContext)) + repr(p) + str(hash(p) == hash(p)))
        match p.channels:
            case 1: protocol.comment("one")
        cfg = defaultdict(list)
        for row, w in itertools.product("AB", range(2)): cfg[row].append(plate[f"{row}{w + 1}"])
        protocol.comment(str({k: [x.well_name for x in v] for k, v in cfg.items()}))
        while (left := len(cfg["A"])):
            p.transfer(15, cfg["A"].pop(), plate["H1"].top(-2), touch_tip=True, air_gap=5, mix_after=(1, 10))
        try:
            for _ in range(200): p.pick_up_tip(); p.drop_tip()
        except types.__dict__.get("X", Exception) as e:
            protocol.comment(type(e).__name__ + "|" + str(e))
        try:
            p.aspirate(10, plate["A1"])
        except Exception as e:
            protocol.comment(type(e).__name__ + "|" + str(e)[:100])
        tips.reset()
        p.pick_up_tip(tips["C5"]); p.aspirate(10, plate["A1"]); p.return_tip()
    finally:
        del InstrumentContext.shake
    return {"anything": 1}
