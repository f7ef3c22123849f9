"""Words and numbers beside wells, whatever the plate map looks like."""

from __future__ import annotations

import pytest

from tests.support.rehearsing import ot2, run


def names(body: str, before: str = ""):
    _, rehearsal = run(before + ot2(body))
    return {binding.name: binding for binding in rehearsal.names}


def told(binding):
    return [(row.spots, tuple(ref.name for ref in row.wells), row.said) for row in binding.rows]


@pytest.mark.parametrize(
    ("value", "rows"),
    [
        ("{'A1': 'NTC', 'A2': 'sample 1'}",
         [(("A1",), (), (("", "NTC"),)), (("A2",), (), (("", "sample 1"),))]),
        ("{plate['A1']: 'NTC'}", [((), ("A1",), (("", "NTC"),))]),
        ("{'A1': {'content': 'NTC', 'dose': 0.5}}",
         [(("A1",), (), (("content", "NTC"), ("dose", 0.5)))]),
        ("[{'well': 'A1', 'content': 'no template control'}]",
         [(("A1",), (), (("content", "no template control"),))]),
        ("[['Well', 'Content'], ['A1', 'NTC'], ['B1', '5']]",
         [(("A1",), (), (("Content", "NTC"),)), (("B1",), (), (("Content", "5"),))]),
        ("[(plate['H12'], 'NTC', 0.5)]", [((), ("H12",), (("", "NTC"), ("", 0.5)))]),
        ("[Sample('A1', 'NTC')]", [(("A1",), (), (("content", "NTC"),))]),
        ("list(__import__('csv').DictReader(['well,content', 'A1,NTC']))",
         [(("A1",), (), (("content", "NTC"),))]),
    ],
)  # fmt: skip
def test_a_plate_map_is_read_row_by_row(value, rows):
    before = """
from dataclasses import dataclass
@dataclass
class Sample:
    well: str
    content: str
"""
    assert told(names(f"layout = {value}\n", before)["layout"]) == rows


@pytest.mark.parametrize(
    "value",
    [
        "{'A1': 'B1'}",
        "['NTC', 'sample']",
        "{'volume': 5, 'rate': 2}",
        "[[1, 2], [3, 4]]",
        "'A1 or B1'",
    ],
)
def test_what_names_no_well_beside_words_is_no_plate_map(value):
    found = names(f"layout = {value}\n").get("layout")
    assert found is None or (found.rows, found.spots) == ((), ())


def test_well_names_are_told_as_such():
    found = names(
        "ntc_well = 'A12'\nblanks = ['H11', 'H12']\n"
        "where = {'ntc': 'B1', 'samples': ['C1', 'D1']}\n"
    )
    assert found["ntc_well"].spots == ("A12",)
    assert found["blanks"].spots == ("H11", "H12")
    assert found["where['ntc']"].spots == ("B1",)
    assert found["where['samples']"].spots == ("C1", "D1")


def test_lists_beside_the_wells_and_notes_on_them():
    found = names("doses = [0, 0.5, 1]\nplate['C3'].content = 'NTC'\n")
    assert found["doses"].values == (0, 0.5, 1)
    assert told(found["content"]) == [((), ("C3",), (("content", "NTC"),))]


def test_a_list_that_grows_is_read_again():
    body = """
    wells = []
    def note():
        seen = wells
        protocol.comment("noted")
    wells.append("A1")
    note()
    protocol.comment("next")
    wells.append("B1")
    note()
    """
    _, rehearsal = run(ot2(body))
    assert [b.spots for b in rehearsal.names if b.name == "seen"] == [("A1",), ("A1", "B1")]


def test_dicts_of_numbers_and_arrays_are_told():
    found = names(
        "import numpy\nug_ml = dict(zip('AB', (200, 0)))\nmixed = {'a': 1, 'b': 'x'}\n"
        "conc = numpy.linspace(0, 1, 3)\n"
    )
    assert found["ug_ml"].numbers == (("A", 200), ("B", 0))
    assert "mixed" not in found
    assert found["conc"].values == (0.0, 0.5, 1.0)


def test_an_object_with_several_wells_is_one_row():
    before = (
        "class Job:\n    def __init__(self, name, wells):\n        vars(self).update(locals())\n"
    )
    found = names("jobs = [Job('NTC', plate.columns()[0][:2]), Job('s1', ['A2', 'B2'])]\n", before)
    (spots, wells, said), (more, none, _) = told(found["jobs"])
    assert (wells, said) == (("A1", "B1"), (("name", "NTC"),))
    assert (spots, more, none) == ((), ("A2", "B2"), ())


def test_members_of_an_enum_are_words_beside_wells():
    before = (
        "from enum import Enum, auto\n"
        "class Role(Enum):\n    NTC = 'water'\n    VEHICLE = 'vehicle control'\n"
        "    BLANK = auto()\n"
        "class Tube(str, Enum):\n    MIX = 'D6'\n"
    )
    found = names(
        "layout = {'A1': Role.NTC, plate['A2']: Role.VEHICLE, 'A3': Role.BLANK}\n"
        "groups = {Role.NTC: plate.columns()[0][:2]}\n",
        before,
    )
    assert [said for _, _, said in told(found["layout"])] == [
        (("", "NTC water"),),
        (("", "vehicle control"),),
        (("", "BLANK"),),
    ]
    assert [ref.name for ref in found["groups['NTC water']"].wells] == ["A1", "B1"]
    assert found["Tube.MIX"].spots == ("D6",)


def test_objects_within_objects_and_in_slots_are_read_and_no_code_of_theirs_runs():
    before = """
class Reagent:
    __slots__ = ("name", "tube", "empty")
    def __init__(self, name, tube):
        self.name, self.tube = name, tube
    def __getattribute__(self, name):
        raise RuntimeError(name)
class Arm:
    def __init__(self, reagent, wells):
        self.reagent, self.wells = reagent, wells
    @property
    def source(self):
        raise RuntimeError
"""
    found = names(
        "arms = [Arm(Reagent('DMSO', plate['H1']), plate.rows()[0][:2]),"
        " Arm(Reagent('drug', plate['H2']), [])]\n",
        before,
    )
    first, second = found["arms"].rows
    assert first.said == (("reagent.name", "DMSO"),)
    assert [(column, ref.name) for column, ref in first.cells if ref in first.wells] == [
        ("reagent.tube", "H1"),
        ("wells", "A1"),
        ("wells", "A2"),
    ]
    assert [ref.name for ref in second.wells] == ["H2"]


def test_rows_with_wells_alone_are_told_where_their_fields_have_names():
    found = names(
        "jobs = [{'vehicle': plate['A1'], 'well': plate['B1']}]\n"
        "pairs = [(plate['A1'], plate['B1'])]\n"
    )
    ((_, wells, said),) = told(found["jobs"])
    assert (wells, said) == (("A1", "B1"), ())
    assert found["pairs"].rows == ()


def test_what_an_objects_rows_hold_in_the_end_is_told():
    before = """
class Job:
    def __init__(self):
        self.well = None
class Plan:
    def __init__(self):
        self.jobs = [Job(), Job()]
    def place(self, plate):
        for job, name in zip(self.jobs, ("A1", "B1")):
            job.well = plate[name]
"""
    body = "plan = Plan()\nplan.place(plate)\nplan.place(plate)\n"
    _, rehearsal = run(before + ot2(body))
    told_wells = [
        tuple(ref.name for row in binding.rows for ref in row.wells)
        for binding in rehearsal.names
        if binding.name in ("plan.jobs", "self.jobs") and binding.rows
    ]
    assert ("A1", "B1") in told_wells
