"""Looking at a protocol's names never disturbs it."""

from __future__ import annotations

import sys
import time

import pytest

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
    _, rehearsal = run(ot2(f"def helper():\n{lines}\nhelper()\nntc = plate['H12']\n"))
    assert "ntc" in {binding.name for binding in rehearsal.names}


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


_PLAIN = """
metadata = {"apiLevel": "2.15"}
def run(protocol):
    import sys
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    before = plate["A1"]
    p300.transfer(50, before, plate["A2"])
    protocol.comment(f"hooked {sys.getprofile() is not None}")
    after = plate["A3"]
"""


@pytest.mark.parametrize("helpers", [0, 1])
def test_names_of_run_are_seen_to_its_end_with_and_without_the_hook(helpers):
    """Without helpers nothing is hooked while the protocol runs: the hook is what costs."""
    helper = "def helper(plate):\n    inner = plate['H12']\n"
    text = _PLAIN.replace("    after =", "    helper(plate)\n    after =") if helpers else _PLAIN
    heard, rehearsal = run(text + helper * helpers)
    names = {(binding.function, binding.name) for binding in rehearsal.names}
    assert {("run", "before"), ("run", "after")} <= names
    assert (("helper", "inner") in names) == bool(helpers)
    said = [event.text for event in heard.events if event.text.startswith("hooked")]
    assert said == [f"hooked {bool(helpers)}"]


def test_a_failing_run_leaves_no_hook_behind():
    with pytest.raises(RehearsalError):
        run(_PLAIN + "    raise ValueError('no')\n")
    assert sys.getprofile() is None
