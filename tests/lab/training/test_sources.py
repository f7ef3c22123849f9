"""The digest of the code that decides the weights, and the shipped weights' own."""

from __future__ import annotations

import ast
import json
from importlib import resources
from pathlib import Path

import pytest

import aegis_ot
from aegis_ot_lab.training.sources import SOURCES, sources_digest

TOP = Path(aegis_ot.__file__).parents[1]
ONLY_TYPES = {"aegis_ot/vision/types"}


def _imported(module: str) -> set[str]:
    """Modules of the rooms that a module imports by their own name, not through a door."""
    folder = Path(module).parent
    found = set()
    for node in ast.walk(ast.parse((TOP / f"{module}.py").read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module:
            origin = Path()
            if node.level:
                origin = folder
                for _ in range(node.level - 1):
                    origin = origin.parent
            name = (origin / node.module.replace(".", "/")).as_posix()
            if (TOP / f"{name}.py").is_file() and any(name.startswith(f"{r}/") for r in SOURCES):
                found.add(name)
    return found


def test_no_module_that_decides_is_left_out() -> None:
    listed = {f"{room}/{name}" for room, names in SOURCES.items() for name in names}
    needed = set().union(*(_imported(module) for module in listed))
    assert needed - listed - ONLY_TYPES == set()


@pytest.fixture(params=["tip_detector", "row_detector"])
def described(request: pytest.FixtureRequest) -> dict:
    """What the description of the shipped weights says: of single tips, and of rows."""
    folder = resources.files("aegis_ot.vision").joinpath("weights")
    return json.loads(folder.joinpath(f"{request.param}.json").read_text(encoding="utf-8"))


def test_the_shipped_weights_were_measured_on_plates_they_did_not_learn(described: dict) -> None:
    assert described["data"]["held_out_plates"]
    recommended = [
        figures
        for name, figures in described["held_out_figures"].items()
        if name.startswith("rendered")  # the others are of any camera, good or bad
    ]
    assert len(recommended) == 2
    for figures in recommended:
        assert figures["found"] >= 0.98
        assert figures["false_alarms"] == 0
        assert figures["highest_empty"] < described["threshold"] < figures["lowest_tip"]


def test_this_code_made_the_shipped_weights(described: dict) -> None:
    """If this fails, 'aegis-ot train detector' no longer gives them: train anew, or undo."""
    made = described["made_with"]
    assert made["sources_sha256"] == sources_digest(without=made["changed_since"])


def test_what_changed_since_is_a_module_that_decides(described: dict) -> None:
    listed = {f"{room}/{name}" for room, names in SOURCES.items() for name in names}
    assert set(described["made_with"]["changed_since"]) <= listed
    assert sources_digest(without=listed) != sources_digest()
