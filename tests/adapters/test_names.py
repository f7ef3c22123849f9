"""Looking at a protocol's names never disturbs it."""

from __future__ import annotations

import itertools
import sys

import pytest

from aegis_ot.adapters.opentrons.instrumentation import EventKind
from aegis_ot.adapters.opentrons.instrumentation.value_reader import ValueReader
from aegis_ot.errors import RehearsalError
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
    helper = f"def helper():\n{lines}\n    protocol.comment('made')\n"
    _, rehearsal = run(ot2(f"{helper}helper()\nntc = plate['H12']\n"))
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
    helper(protocol, plate)
def helper(protocol, plate):
    held = [proxy, Silent]
    protocol.comment("held")
    ntc = plate["H12"]
"""


def test_globals_that_answer_nothing_are_left_alone():
    _, rehearsal = run(_PROXIES)
    assert "ntc" in {binding.name for binding in rehearsal.names}


_LOCALS = """
metadata = {"apiLevel": "2.15"}
def settings(protocol):
    volume = 50
    found = locals()
    found["volume"] = 77
    protocol.comment("changed")
    return found
def each(protocol):
    one, two = 1, 2
    for name in locals():
        protocol.comment("each")
        yield name
def run(protocol):
    protocol.comment(f"{settings(protocol)['volume']} {list(each(protocol))}")
"""


def test_the_dict_that_a_protocol_got_from_locals_stays_as_it_left_it():
    heard, _ = run(_LOCALS)
    told = [event.text for event in heard.events if event.kind is EventKind.COMMENT]
    assert told[-1] == "77 ['protocol', 'one', 'two']"


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


def test_long_tables_cost_nothing(monkeypatch):
    body = """
    rows = [[i, str(i)] for i in range(20000)]
    def helper(i):
        seen = rows
        protocol.comment(seen[i][1])
    for i in range(300):
        helper(i)
    """
    looks = itertools.count()
    read = ValueReader._cells

    def counted(self, value, column=""):
        next(looks)
        return read(self, value, column)

    monkeypatch.setattr(ValueReader, "_cells", counted)
    run(ot2(body))
    assert next(looks) < 20_000  # 300 times as many when every row was looked at every time


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
    helper(p300, plate)
    after = plate["A3"]

def helper(p300, plate):
    p300.pick_up_tip()
    inner = plate["H12"]
    p300.drop_tip()
    last = plate["H11"]
"""


def test_names_of_all_functions_are_seen_to_their_end_without_a_hook():
    """A hook would be told of all of Opentrons' calls too."""
    heard, rehearsal = run(_HELPED)
    names = {(binding.function, binding.name) for binding in rehearsal.names}
    assert {("run", "before"), ("run", "after")} <= names
    assert {("helper", "inner"), ("helper", "last")} <= names
    said = [event.text for event in heard.events if event.text.startswith("hooked")]
    assert said == ["hooked False"]


def bound(body: str, before: str = "") -> dict[tuple[str, str], list[str]]:
    _, rehearsal = run(before + ot2(body))
    return {(b.function, b.name): [well.name for well in b.wells] for b in rehearsal.names}


def test_a_name_whose_value_changes_tells_each_value():
    body = """
    def give(well):
        target = well
        protocol.comment("given")
    for name in ("A1", "B1", "A1"):
        give(plate[name])
    """
    _, rehearsal = run(ot2(body))
    told = [b.wells[0].name for b in rehearsal.names if b.name == "target"]
    assert told == ["A1", "B1"]


def test_a_loop_tells_each_well_that_its_names_held():
    body = """
    def give(source, target):
        single.transfer(50, source, target)
    for standard, well in zip(plate.rows()[0][:3], plate.rows()[1]):
        give(standard, well)
    """
    _, rehearsal = run(ot2(body))
    told = {}
    for binding in rehearsal.names:
        told.setdefault((binding.function, binding.name), []).extend(w.name for w in binding.wells)
    assert told["run", "standard"] == ["A1", "A2", "A3"]
    assert told["run", "well"] == ["B1", "B2", "B3"]
    assert told["give", "source"] == ["A1", "A2", "A3"]


def test_looking_at_a_running_function_keeps_nothing_alive_that_it_lets_go_of():
    body = """
    import weakref
    class Kept: pass
    well, kept = plate["A1"], Kept()
    alive = weakref.ref(kept)
    single.pick_up_tip()
    del kept
    protocol.comment(f"alive {alive() is not None}")
    """
    heard, _ = run(ot2(body))
    assert heard.events[-1].text == "alive False"


def test_a_class_body_with_names_of_its_own_making_is_left_alone():
    body = """
    class Names(dict):
        def items(self):
            raise RuntimeError("boom")
    class Meta(type):
        @classmethod
        def __prepare__(mcs, name, bases):
            return Names()
        def __new__(mcs, name, bases, names):
            return super().__new__(mcs, name, bases, {})
    class Deck(metaclass=Meta):
        ntc = plate["H12"]
        single.pick_up_tip()
    water = plate["A1"]
    """
    assert bound(body)["run", "water"] == ["A1"]


def test_functions_in_functions_classes_and_tables_are_seen():
    body = """
    def inner():
        ntc = plate["H12"]
        protocol.comment("inner")
        return ntc
    inner()
    layout = Layout(plate)
    layout.fill(protocol)
    TABLE["blank"](protocol, plate)
    next(series(protocol, plate))
    """
    before = """
import functools
class Layout:
    def __init__(self, plate):
        self.plate = plate
        self.standard = plate["B1"]
    def fill(self, protocol):
        template = self.plate["A1"]
        protocol.comment("filled")
def of_blank(protocol, plate, name):
    blank = plate[name]
    protocol.comment("blank")
TABLE = {"blank": functools.partial(of_blank, name="C1")}
def series(protocol, plate):
    first = plate["D1"]
    protocol.comment("first")
    yield first
"""
    found = bound(body, before)
    assert found["inner", "ntc"] == ["H12"]
    assert found["fill", "template"] == ["A1"]
    assert found["of_blank", "blank"] == ["C1"]
    assert found["series", "first"] == ["D1"]
    assert found["run", "layout.standard"] == ["B1"]


@pytest.mark.parametrize("place", ["at the top", "in run"])
def test_names_in_helper_modules_beside_the_protocol_are_seen(tmp_path, monkeypatch, place):
    name = f"aegis_test_layout_{place.replace(' ', '_')}"
    (tmp_path / f"{name}.py").write_text(
        "NTC = 'H12'\ndef fill(protocol, plate):\n    ntc = plate[NTC]\n    protocol.comment('')\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    imported, body = f"from {name} import fill\n", "fill(protocol, plate)\n"
    _, rehearsal = run(imported + ot2(body) if place == "at the top" else ot2(imported + body))
    found = {(b.function, b.name): b for b in rehearsal.names}
    assert found[f"{name}.fill", "ntc"].wells[0].name == "H12"
    assert place == "in run" or found[f"{name}.<module>", "NTC"].spots == ("H12",)


def test_who_calls_the_protocol_is_none_of_its_helpers():
    """A script of the user's own, say, that simulates a protocol."""
    own_of_this_test = "A1"
    _, rehearsal = run(ot2("protocol.comment('said')"))
    assert own_of_this_test
    assert "own_of_this_test" not in {b.name for b in rehearsal.names}


def test_of_a_helper_that_does_nothing_to_the_robot_what_it_gives_counts():
    body = """
    def layout():
        inner = plate["H12"]
        return {"ntc": inner}
    wells = layout()
    protocol.comment(str(wells["ntc"]))
    """
    found = bound(body)
    assert found["run", "wells['ntc']"] == ["H12"]
    assert ("layout", "inner") not in found


def test_a_list_that_is_filled_to_the_end_is_read_to_the_end():
    body = """
    blanks = []
    for name in ("A1", "B1"):
        single.transfer(20, reservoir["A1"], plate[name])
        blanks.append(plate[name])
    """
    assert bound(body)["run", "blanks"] == ["A1", "B1"]


def test_a_definition_of_labware_tells_of_no_wells_use():
    definition = "{'schemaVersion': 2, 'ordering': [['A1']], 'wells': {'A1': {'x': 1, 'y': 2}}}"
    _, rehearsal = run(ot2(f"definition = {definition}\nntc = plate['H12']"))
    assert {b.name for b in rehearsal.names} >= {"ntc"}
    assert not [b.name for b in rehearsal.names if b.name.startswith("definition")]


def test_what_a_function_held_is_let_go_once_the_next_step_is_done():
    body = """
    import weakref
    class Kept: pass
    def helper():
        kept = Kept()
        seen.append(weakref.ref(kept))
        protocol.comment("helping")
    seen = []
    helper()
    protocol.comment("next")
    protocol.comment(f"alive {seen[0]() is not None}")
    """
    heard, _ = run(ot2(body))
    assert heard.events[-1].text == "alive False"


def test_a_failing_run_leaves_nothing_behind():
    with pytest.raises(RehearsalError):
        run(_HELPED + "    raise ValueError('no')\n")
    assert sys.getprofile() is None
