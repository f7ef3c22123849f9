"""The nodes of a text by kind, with the function that they are in."""

from __future__ import annotations

import ast

from aegis_ot.preflight.source.nodes import LOOPS, Nodes

TEXT = """\
def run(protocol):
    for well in plate.wells():
        tip = [pick(rack) for rack in racks]

        def inner(volume: float = 3):
            left = volume
    last = 1
"""


def test_nodes_come_in_reading_order_within_their_kind() -> None:
    numbers = [node.value for node in Nodes(ast.parse("a = 1\nb = [2, {3: 4}]\n")).of(ast.Constant)]
    assert numbers == [1, 2, 3, 4]


def test_each_name_knows_its_function_and_the_loops_around_it() -> None:
    placed = {
        node.id: (function, looping)
        for node, function, looping in Nodes(ast.parse(TEXT)).placed(ast.Name)
        if isinstance(node.ctx, ast.Store)
    }
    assert placed == {
        "well": ("run", ("run",)),
        "tip": ("run", ("run",)),
        "rack": ("run", ("run", "run")),
        "left": ("inner", ("run",)),
        "last": ("run", ()),
    }


def test_annotations_say_nothing() -> None:
    assert "float" not in {node.id for node in Nodes(ast.parse(TEXT)).of(ast.Name)}


def test_several_kinds_come_one_after_the_other() -> None:
    kinds = [type(node) for node in Nodes(ast.parse(TEXT)).of(*LOOPS)]
    assert kinds == [ast.For, ast.comprehension]


def test_no_tree_holds_no_nodes() -> None:
    assert list(Nodes(ast.parse("")).of(ast.Name)) == []
