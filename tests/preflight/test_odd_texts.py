"""Odd constants and long texts are read in no time, and never end the check."""

from __future__ import annotations

import time

import pytest

from aegis_ot.preflight import Report, Script, check_script, load_rules
from aegis_ot.vocabulary import VerdictWord

_PROTOCOL = '''metadata = {{"apiLevel": "2.13"}}
{head}


def run(ctx):
    """{doc}"""
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2, "tubes")
    plate = ctx.load_labware("nest_96_wellplate_100ul_pcr_full_skirt", 3, "plate")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p20.transfer(10, rack["A1"], plate.columns()[0])
    p20.transfer(5, rack["B1"], plate.columns()[0], new_tip="always")
'''

_SECONDS = 8.0
"""Of the processor; far more than any of these takes."""


def _check(head: str = "", doc: str = "What it does.") -> Report:
    return check_script(Script(_PROTOCOL.format(head=head, doc=doc), "p.py"), load_rules())


@pytest.mark.parametrize(
    "head",
    [
        f"DOSES = [1{'0' * 400}, 1, 2]",
        f"MOVES = [('A1', 'H12', 1{'0' * 400}), ('A2', 'H11', 5)]",
        "MOVES = [('A1', 'H12', None), ('A2', b'H11', 5), (), [], {}, set(), ...]",
        "MAP = {1: 'A1', None: 'A2', (1, 2): 'A3', b'x': ['A4'], True: {'a': 1}, 2.5: 'A5'}",
        "EMPTY = [[], [], []]\nMIXED = [['A1', []], ['A2', []]]",
        "TABLE = 'A1,B1,nan\\nA2,B2,inf\\nA3,B3,1e999'",
        "NOTHING = '\\n\\n'\nBARS = '|\\n|'\nHASH = '#\\n#'",
        "MANY = range(10000000000000000000000)",
        "LARGE = 'AF48 x\\nAE12 y\\nP24 z'",
        "GRID = 'plate,1,²\\nA,water,dye\\nB,water,dye'\nCOLUMNS = {'²': 'A1', '1': 'A2'}",
        f"# columns 1-{'9' * 5000} water\n# A1-A{'9' * 12} x\n# columns 1-99999999 dye",
    ],
)
def test_odd_constants_are_no_fault(head: str) -> None:
    assert _check(head).verdict is VerdictWord.PASS


@pytest.mark.parametrize(
    ("head", "doc"),
    [
        (f"WORD = '{'x' * 500_000}'", ""),
        (f"# {'x' * 5000}", ""),
        (f"# A1{' ' * 50_000}x\n# columns 1{' ' * 50_000}2", ""),
        ("", f"rows A{' ' * 50_000}B\n\n column{' ' * 50_000}1\n A1{' ' * 50_000}- A2 water"),
        (f"CELLS = {'a' + ' ' * 3000 + '|'!r} * 1\nROWS = {('a' + ' ' * 3000 + '|') * 200!r}", ""),
        (f"# {'row A, ' * 4000}", ""),
        ("", "\n".join(["A1 B1 C1"] * 1500)),
        ("", "\n".join(["of t A1 B1 C1", "is s x y z"] * 750)),
        ("", "\n".join(["1 2 3"] * 3000)),
        (f"# {'x   ' * 8000}", ""),
    ],
)
def test_long_texts_are_read_in_no_time(head: str, doc: str) -> None:
    start = time.process_time()
    assert _check(head, doc).verdict is VerdictWord.PASS
    assert time.process_time() - start < _SECONDS
