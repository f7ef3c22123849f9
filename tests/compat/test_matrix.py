"""The guard changes nothing, and needs nothing else, on each ``opentrons`` that this machine runs.

The environments are made by ``make matrix``; without them the main environment is tested alone,
and the tests say what they left out.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from opentrons.protocols.api_support.definitions import MAX_SUPPORTED_VERSION

from .environments import MATRIX, ROOT, Environment

FULL = "AEGIS_OT_FULL" in os.environ
"""Whether every cell is tried with every protocol: minutes more, see ``make full``."""

LOGS = {"py310-ot8", "py312-ot10"}
"""Where run logs are compared too: with the usual release of an OT-2, and with the newest."""
PROTOCOLS = ROOT / "tests" / "protocols" / "transparency"


def run_in(python: str | Path, *arguments: str) -> str:
    """Run a module of this repository in another interpreter; returns what it printed."""
    environ = {k: v for k, v in os.environ.items() if not k.startswith("AEGIS_OT_")}
    done = subprocess.run(
        [str(python), *arguments],
        cwd=ROOT,
        env={**environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=900,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stdout


def problems_of(
    python: str | Path, robots: tuple[str, ...], newest: int, logs: bool = True, every: int = 1
) -> list[str]:
    files = sorted(
        str(path)
        for robot in robots
        for path in PROTOCOLS.glob(f"{robot}_*.py")
        if int(path.name.split("_")[1]) <= newest
    )[:: 1 if FULL else every]
    how = [] if logs else ["--commands"]
    report: dict[str, Any] = json.loads(
        run_in(python, "-m", "tests.compat.transparency", *how, *files)
    )
    compared = report["protocols"]
    assert len(compared) == len(files)
    assert sum(one.get("keyframes", 0) for one in compared) > 100, "Layer 2 was not at work"
    foreign = set(report["modules"]) - {"aegis_ot"} - set(sys.stdlib_module_names)
    problems = [f"The robot half loads {name}." for name in sorted(foreign)]
    for path, one in zip(map(Path, files), compared, strict=True):
        expected = re.search(r"^# raises: (.+)$", path.read_text("utf-8"), re.MULTILINE)
        if bool(expected) != bool(one["own_error"]):
            problems.append(f"{path.name}: it ended with {one['own_error']}")
        problems += [f"{path.name}: {problem}" for problem in one["problems"]]
    return problems


def ready(environment: Environment) -> Environment:
    if not environment.ready:
        pytest.skip(f"{environment.name} is not there; `make matrix` makes it")
    return environment


needed = pytest.mark.skipif(
    all(e.ready for e in MATRIX), reason="its release and its Python are tried in the others"
)


@needed
@pytest.mark.slow
@pytest.mark.timeout(900)
def test_liquid_commands_are_unchanged_here():
    assert problems_of(sys.executable, ("ot2", "flex"), MAX_SUPPORTED_VERSION.minor) == []


@pytest.mark.slow
@pytest.mark.timeout(900)
@pytest.mark.parametrize("environment", MATRIX, ids=lambda e: e.name)
def test_liquid_commands_are_unchanged(environment):
    e = ready(environment)
    assert problems_of(e.interpreter, e.robots, e.newest, e.name in LOGS, e.every) == []


def flex_stories_of(python: str | Path) -> dict[str, str]:
    told = json.loads(run_in(python, "-m", "tests.compat.flex_live"))
    assert len(told) == 6
    return {story: problem for story, problem in told.items() if problem}


@needed
def test_a_live_flex_is_guarded_here():
    assert flex_stories_of(sys.executable) == {}


@pytest.mark.parametrize(
    "environment", [e for e in MATRIX if "flex" in e.robots], ids=lambda e: e.name
)
def test_a_live_flex_is_guarded(environment):
    if not FULL and environment.name == "py313-ot8":
        pytest.skip("its release is tried under another Python; `make full` tries both")
    assert flex_stories_of(ready(environment).interpreter) == {}
