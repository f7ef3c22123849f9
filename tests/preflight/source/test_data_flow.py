"""Which labware is indexed with the values of a name."""

from __future__ import annotations

import ast

import pytest

from aegis_ot.preflight.source.data_flow import read_flow
from aegis_ot.preflight.source.nodes import Nodes


def indexed(text: str, name: str) -> set[str]:
    return {use.indexed for use in read_flow(Nodes(ast.parse(text))).indexed_with.get(name, [])}


@pytest.mark.parametrize(
    "text",
    [
        "plate[LAYOUT['ntc']]",
        "for well, kind in LAYOUT.items():\n    plate[well]",
        "for n, well in enumerate(LAYOUT):\n    plate[well]",
        "[plate[w] for w in sorted(LAYOUT)]",
        "def give(well):\n    plate.wells_by_name()[well]\nfor w in LAYOUT:\n    give(w)",
        "rows = list(LAYOUT)\nfor row in rows:\n    plate.wells(row)",
    ],
)
def test_a_constant_is_followed_to_its_index(text: str) -> None:
    assert indexed(text, "LAYOUT") == {"plate"}


def test_a_zip_is_taken_apart() -> None:
    text = "for tube, well in zip(SOURCES, WELLS):\n    rack[tube]\n    plate[well]"
    assert indexed(text, "SOURCES") == {"rack"}
    assert indexed(text, "WELLS") == {"plate"}
