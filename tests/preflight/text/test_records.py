"""Tables whose rows are objects: the fields of each row, as far as they are written down."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.text import read_source

ZONE = (
    "@dataclass\nclass Zone:\n    kind: str\n    columns: range\n    source: str = ''\n"
    "    def wells(self): pass\n"
)
SPOT = "Spot = namedtuple('Spot', 'tube, wells')\n"


def records(text: str) -> dict[str, list[dict[str, object]]]:
    return read_source(text).records


@pytest.mark.parametrize(
    ("made_of", "rows", "expected"),
    [
        (
            ZONE,
            "[Zone('vehicle', range(2, 4), 'A1'), Zone('drug', range(4, 6))]",
            [
                {"kind": "vehicle", "columns": [2, 3], "source": "A1"},
                {"kind": "drug", "columns": [4, 5]},
            ],
        ),
        (
            ZONE,
            "(Zone(columns=[7], kind='drug'), Zone('mock', columns=list(range(8, 10))))",
            [{"columns": [7], "kind": "drug"}, {"kind": "mock", "columns": [8, 9]}],
        ),
        (
            "class Row(NamedTuple):\n    tube: str\n    conc: float\n",
            "[Row('A1', 0.5), Row('A2', 1)]",
            [{"tube": "A1", "conc": 0.5}, {"tube": "A2", "conc": 1}],
        ),
        (
            SPOT,
            "[Spot('A1', ['B1', 'C1']), Spot('A2', ['B2'])]",
            [{"tube": "A1", "wells": ["B1", "C1"]}, {"tube": "A2", "wells": ["B2"]}],
        ),
        (
            "Spot = collections.namedtuple('Spot', ['tube', 'well'])\n",
            "[Spot('A1', 'H1'), Spot('A2', 'H2')]",
            [{"tube": "A1", "well": "H1"}, {"tube": "A2", "well": "H2"}],
        ),
        (
            "",
            "[dict(col=3, cond='mock'), dict(col=4, cond='drug')]",
            [{"col": 3, "cond": "mock"}, {"col": 4, "cond": "drug"}],
        ),
        (
            ZONE + "class Kind(Enum):\n    DRUG = 1\n    MOCK = 2\n",
            "[Zone(Kind.DRUG, range(1, 2)), Zone(Kind.MOCK, range(2, 3))]",
            [{"kind": "DRUG", "columns": [1]}, {"kind": "MOCK", "columns": [2]}],
        ),
    ],
    ids=["dataclass", "keywords", "NamedTuple", "namedtuple", "names in a list", "dict", "Enum"],
)
def test_each_row_with_its_fields(made_of, rows, expected) -> None:
    assert records(f"{made_of}ROWS = {rows}\n") == {"ROWS": expected}


def test_a_list_with_its_type_said_and_one_inside_a_function() -> None:
    text = f"{SPOT}def run(ctx):\n    spots: list[Spot] = [Spot('A1', 'B1'), Spot('A2', 'B2')]\n"
    assert [row["tube"] for row in records(text)["spots"]] == ["A1", "A2"]


def test_what_the_run_computes_is_no_field() -> None:
    rows = "[Zone('drug', range(first, 4)), Zone('mock', next(columns), 'A' + row)]"
    assert records(f"{ZONE}ROWS = {rows}\n") == {"ROWS": [{"kind": "drug"}, {"kind": "mock"}]}


@pytest.mark.parametrize(
    "rows",
    [
        "[Zone(kind, columns) for kind, columns in plan]",
        "[Zone(kind_of(1), first), Zone(kind_of(2), second)]",
        "[Zone('drug', range(1, 3)), make('mock')]",
        "[Zone('drug', range(1, 3)), ('mock', 3)]",
        "[Zone('drug', range(1, 3))]",
        "[Zone(), Zone()]",
        "[Other('drug', 3), Other('mock', 4)]",
        "Zone('drug', range(1, 3))",
        "[]",
    ],
)
def test_no_table_without_two_rows_that_say_something(rows: str) -> None:
    assert records(f"{ZONE}ROWS = {rows}\n") == {}
