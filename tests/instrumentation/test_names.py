"""Looking at a protocol's names never disturbs it."""

from __future__ import annotations

import sys
import time

import pytest

from aegis_ot.errors import RehearsalError
from aegis_ot.instrumentation import EventKind, NameCollector
from tests.support.rehearsing import ot2, run


@pytest.mark.parametrize(
    "made",
    [
        "class C:\n    def __getattr__(self, name): return {}[name]\nheld = C()",
        "class C:\n    @property\n    def _core(self): raise RuntimeError('none')\nheld = C()",
        "from unittest.mock import MagicMock\nheld = MagicMock()",
        "class L(list):\n    def __iter__(self): raise ValueError('no')\nheld = L([1])",
        "class D(dict):\n    def items(self): raise ValueError('no')\nheld = D(a=1)",
        "held = []\nheld.append(held)",
        "held = {}\nheld['held'] = held",
    ],
)
def test_odd_objects_are_left_alone(made):
    lines = "\n".join(f"    {line}" for line in made.splitlines())
    _, rehearsal = run(ot2(f"def helper():\n{lines}\nhelper()\nntc = plate['H12']\n"))
    assert "ntc" in {binding.name for binding in rehearsal.names}


_PROXIES = """
metadata = {"apiLevel": "2.15"}
class Proxy:
    def __getattribute__(self, name):
        raise RuntimeError("bound to nothing: " + name)
class Meta(type):
    def __getattribute__(cls, name):
        raise RuntimeError("not told: " + name)
class Silent(metaclass=Meta):
    pass
proxy = Proxy()
table = {"proxy": proxy, "silent": Silent}
def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    helper(plate)
def helper(plate):
    held = [proxy, Silent]
    ntc = plate["H12"]
"""


def test_globals_that_answer_nothing_are_left_alone():
    _, rehearsal = run(_PROXIES)
    assert "ntc" in {binding.name for binding in rehearsal.names}


_LOCALS = """
metadata = {"apiLevel": "2.15"}
def settings():
    volume = 50
    found = locals()
    found["volume"] = 77
    return found
def each():
    one, two = 1, 2
    for name in locals():
        yield name
def run(protocol):
    protocol.comment(f"{settings()} {list(each())}")
"""


def test_the_dict_that_a_protocol_got_from_locals_stays_as_it_left_it():
    heard, _ = run(_LOCALS)
    told = [event.text for event in heard.events if event.kind is EventKind.COMMENT]
    assert told == ["{'volume': 77} ['one', 'two']"]


def test_a_well_of_another_context_is_left_alone():
    body = """
    from opentrons import simulate
    other = simulate.get_protocol_api("2.15").load_labware("corning_96_wellplate_360ul_flat", 5)
    stray = other["A1"]
    ntc = plate["H12"]
    """
    _, rehearsal = run(ot2(body))
    assert "ntc" in {binding.name for binding in rehearsal.names}


def test_named_tuples_and_lists_of_lists_are_seen():
    body = """
    from collections import namedtuple
    Pair = namedtuple("Pair", "source target")
    pair = Pair(plate["A1"], plate["A2"])
    rows = plate.rows()
    """
    _, rehearsal = run(ot2(body))
    wells = {b.name: [w.name for w in b.wells] for b in rehearsal.names}
    assert wells["pair"] == ["A1", "A2"]
    assert len(wells["rows"]) == 96


def test_long_tables_cost_nothing():
    body = """
    rows = [[i, str(i)] for i in range(20000)]
    def helper(i):
        seen = rows
        return seen[i]
    for i in range(300):
        helper(i)
    """
    began = time.monotonic()
    run(ot2(body))
    assert time.monotonic() - began < 15  # 90 s when every row was looked at every time


def test_a_helper_that_computes_is_not_looked_at_for_ever(monkeypatch):
    """Each look takes 10 µs: fib(25) took the guard three seconds."""
    text = """
    metadata = {"apiLevel": "2.15"}
    def fib(n):
        return n if n < 2 else fib(n - 1) + fib(n - 2)
    def run(protocol):
        plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
        fib(20)
        ntc = plate["H12"]
    """
    looks = []
    look = NameCollector.look

    def counted(self, names, function, line):
        looks.append(function)
        look(self, names, function, line)

    monkeypatch.setattr(NameCollector, "look", counted)
    _, rehearsal = run(text)
    assert looks.count("fib") == 5000
    assert "ntc" in {binding.name for binding in rehearsal.names}


_HELPED = """
metadata = {"apiLevel": "2.15"}
def run(protocol):
    import sys
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    before = plate["A1"]
    p300.transfer(50, before, plate["A2"])
    protocol.comment(f"hooked {sys.getprofile() is not None}")
    helper(plate)
    after = plate["A3"]

def helper(plate):
    inner = plate["H12"]
"""


def test_names_of_all_functions_are_seen_to_their_end_without_a_hook():
    """A hook would be told of all of Opentrons' calls too."""
    heard, rehearsal = run(_HELPED)
    names = {(binding.function, binding.name) for binding in rehearsal.names}
    assert {("run", "before"), ("run", "after"), ("helper", "inner")} <= names
    said = [event.text for event in heard.events if event.text.startswith("hooked")]
    assert said == ["hooked False"]


def bound(body: str, before: str = "") -> dict[tuple[str, str], list[str]]:
    _, rehearsal = run(before + ot2(body))
    return {(b.function, b.name): [well.name for well in b.wells] for b in rehearsal.names}


def test_a_name_whose_value_changes_tells_each_value():
    before = "def give(well):\n    target = well\n"
    _, rehearsal = run(before + ot2("for name in ('A1', 'B1', 'A1'):\n    give(plate[name])\n"))
    told = [b.wells[0].name for b in rehearsal.names if b.name == "target"]
    assert told == ["A1", "B1"]


def test_functions_in_functions_classes_and_tables_are_seen():
    body = """
    def inner():
        ntc = plate["H12"]
        return ntc
    inner()
    layout = Layout(plate)
    layout.wells()
    TABLE["blank"](plate)
    next(series(plate))
    """
    before = """
import functools
class Layout:
    def __init__(self, plate):
        self.plate = plate
        self.standard = plate["B1"]
    def wells(self):
        template = self.plate["A1"]
        return [template]
def of_blank(plate, name):
    blank = plate[name]
TABLE = {"blank": functools.partial(of_blank, name="C1")}
def series(plate):
    first = plate["D1"]
    yield first
"""
    found = bound(body, before)
    assert found["inner", "ntc"] == ["H12"]
    assert found["wells", "template"] == ["A1"]
    assert found["of_blank", "blank"] == ["C1"]
    assert found["series", "first"] == ["D1"]
    assert found["run", "layout.standard"] == ["B1"]


def test_names_in_helper_modules_beside_the_protocol_are_seen(tmp_path, monkeypatch):
    (tmp_path / "aegis_test_layout.py").write_text(
        "NTC = 'H12'\ndef wells_of(plate):\n    ntc = plate[NTC]\n    return [ntc]\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    import aegis_test_layout  # type: ignore[import-not-found]

    code = aegis_test_layout.wells_of.__code__
    _, rehearsal = run(ot2("from aegis_test_layout import wells_of\nwells_of(plate)\n"))
    assert "ntc" not in {b.name for b in rehearsal.names}  # imported too late to be known
    text = "from aegis_test_layout import wells_of\n" + ot2("wells_of(plate)\n")
    _, rehearsal = run(text)
    found = {(b.function, b.name): b for b in rehearsal.names}
    assert found["aegis_test_layout.wells_of", "ntc"].wells[0].name == "H12"
    assert found["aegis_test_layout.<module>", "NTC"].spots == ("H12",)
    assert aegis_test_layout.wells_of.__code__ is code


def test_a_failing_run_leaves_nothing_behind():
    with pytest.raises(RehearsalError):
        run(_HELPED + "    raise ValueError('no')\n")
    assert sys.getprofile() is None
