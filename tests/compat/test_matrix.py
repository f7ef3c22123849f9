"""The guard changes nothing, on each ``opentrons`` that this machine can run.

The environments are made by ``make matrix``; without them the main environment is tested alone,
and the tests say what they left out.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from opentrons.protocols.api_support.definitions import MAX_SUPPORTED_VERSION

from .environments import MATRIX, ROOT, Environment

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


def problems_of(python: str | Path, robots: tuple[str, ...], newest: int = 99) -> list[str]:
    files = sorted(
        str(path)
        for robot in robots
        for path in PROTOCOLS.glob(f"{robot}_*.py")
        if int(path.name.split("_")[1]) <= newest
    )
    report = json.loads(run_in(python, "-m", "tests.compat.transparency", *files))
    compared = report["protocols"]
    assert len(compared) == len(files)
    assert sum(one.get("keyframes", 0) for one in compared) > 100, "Layer 2 was not at work"
    return [f"{one['file']}: {problem}" for one in compared for problem in one["problems"]]


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
    python = ready(environment).interpreter
    assert problems_of(python, environment.robots, environment.newest) == []


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
    assert flex_stories_of(ready(environment).interpreter) == {}


ALONE = """
import json, sys
import opentrons.simulate
before = set(sys.modules)
import time; begun = time.perf_counter()
from aegis_ot import guard
seconds = time.perf_counter() - begun
import aegis_ot.guarded_run, aegis_ot.preflight.check_protocol
import aegis_ot.adapters.opentrons.rehearsal, aegis_ot.adapters.opentrons.instrumentation
import aegis_ot.runtime, aegis_ot.settings
new = sorted({name.split(".")[0] for name in set(sys.modules) - before})
print(json.dumps({"new": new, "seconds": seconds}))
"""


@pytest.mark.parametrize("environment", MATRIX, ids=lambda e: e.name)
def test_the_robot_half_needs_nothing_but_opentrons(environment):
    python = ready(environment).interpreter
    told = json.loads(run_in(python, "-c", ALONE))
    foreign = set(told["new"]) - {"aegis_ot"} - set(sys.stdlib_module_names)
    assert foreign == set()
