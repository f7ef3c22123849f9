"""A wrapped protocol: one file, the same lines, the guard inside, nothing installed."""

from __future__ import annotations

import ast
import functools
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.robot.bundle import Bundle, make_bundle, stripped
from aegis_ot.robot.wrapping import wrap

from ..compat.environments import MATRIX
from .protocols import GOOD

ROOT = Path(__file__).parents[2]
made = functools.cache(make_bundle)
SMALL = Bundle("aegis_ot_0", "MADE", 1)
SAFE = GOOD.replace("plate.wells()[8:10])", 'plate.wells()[8:10], new_tip="always")')
BROKEN = SAFE + '    raise ValueError("here")\n'
CONTAMINATED = (ROOT / "examples" / "demo" / "pcr_setup_contaminated.py").read_text("utf-8")
RUN = """
import io, json, logging, os, sys
logging.disable(logging.CRITICAL)
import opentrons.simulate as simulate

class Blocked:  # whatever opentrons has not brought along already
    known = {name.partition(".")[0] for name in sys.modules} | set(sys.stdlib_module_names)

    def find_spec(self, name, path=None, target=None):
        root = name.partition(".")[0]
        if root not in self.known and not root.startswith("aegis_ot_"):
            raise ImportError(f"{name} is no part of Python or opentrons")

sys.meta_path.insert(0, Blocked())
for text in json.load(open(sys.argv[1])):
    if os.fork():
        os.wait()
        continue
    found = []
    for _ in range(2):
        try:
            log, _ = simulate.simulate(io.StringIO(text), "protocol.py", log_level="none")
            found.append([entry["payload"].get("text", "") for entry in log])
        except Exception as error:
            found.append(str(error))
    print("FOUND", json.dumps(found), flush=True)
    os._exit(0)
"""


def alone(
    texts: list[str], folder: Path, python: str | Path = sys.executable
) -> list[list[list[str] | str]]:
    """Simulate each twice, in a process of its own that has no aegis_ot."""
    path = folder / "protocols.json"
    path.write_text(json.dumps(texts), encoding="utf-8")
    bare = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    hidden = "import sys; sys.modules['aegis_ot'] = None\n"  # importing it would fail
    done = subprocess.run(
        [str(python), "-c", hidden + RUN, str(path)],
        capture_output=True, text=True, cwd=folder, env=bare, check=False,
    )  # fmt: skip
    found = [line[6:] for line in done.stdout.splitlines() if line.startswith("FOUND ")]
    assert len(found) == len(texts), done.stderr[-3000:]
    return [json.loads(runs) for runs in found]


@pytest.fixture(scope="module")
def simulated(tmp_path_factory: pytest.TempPathFactory) -> list[list[list[str] | str]]:
    """A plain protocol, the same wrapped, a guarded one and a broken one."""
    wrapped = [
        wrap(SAFE, {"assay": "generic"}, made()),
        wrap(CONTAMINATED, bundle=made()),
        wrap(BROKEN, bundle=made()),
    ]
    return alone([SAFE, *(one.text for one in wrapped)], tmp_path_factory.mktemp("wrapped"))


def test_an_unguarded_protocol_is_guarded_and_does_the_same(simulated) -> None:  # type: ignore[no-untyped-def]
    for before, after in zip(*simulated[:2], strict=True):
        assert [line for line in after if not line.startswith("aegis_ot: ")] == before
        assert after[-1].startswith("aegis_ot: Layer 1: ")


def test_a_guarded_protocol_finds_the_guard_inside(simulated) -> None:  # type: ignore[no-untyped-def]
    wrapped = wrap(CONTAMINATED, bundle=made())
    assert wrapped.guarded_before
    assert all("Layer 1 found" in run for run in simulated[2])
    # The lines of the findings are the original's.
    assert len(wrapped.text.splitlines()) == len(CONTAMINATED.splitlines())
    assert "ProtocolRejected [line " in simulated[2][0]


def test_findings_and_errors_keep_their_lines(simulated) -> None:  # type: ignore[no-untyped-def]
    line = len(BROKEN.splitlines())
    assert f"ValueError [line {line}]: here" in simulated[3][0]


@pytest.mark.parametrize("environment", MATRIX, ids=lambda e: e.name)
def test_it_runs_where_there_is_nothing_but_opentrons(environment, tmp_path):  # type: ignore[no-untyped-def]
    if not environment.ready or "ot2" not in environment.robots:
        pytest.skip(f"{environment.name} is not there, or simulates no OT-2")
    (told,) = alone([wrap(SAFE, bundle=made()).text], tmp_path, environment.interpreter)
    assert told[0][-1].startswith("aegis_ot: Layer 1: ")


@pytest.mark.parametrize(
    ("text", "first_lines"),
    [
        ('"""Doc."""\n\nx = 1\ndef run(p): ...\n', ['"""Doc."""', "MADE", "x = 1"]),
        ('"""Doc."""\nx = 1\ndef run(p): ...\n', ['"""Doc."""', "MADE; x = 1"]),
        ('"""Doc\n\nlong."""\ndef run(p): ...\n', ['"""Doc', "", 'long."""; MADE']),
        ("# by me\nx = 1\ndef run(p): ...\n", ["MADE  # by me", "x = 1"]),
        ("#!/usr/bin/python\nx = 1\ndef run(p): ...\n", ["#!/usr/bin/python", "MADE; x = 1"]),
        ("from __future__ import annotations\ndef run(p): ...\n",
         ["from __future__ import annotations; MADE", "def run(p): ..."]),
        ("x = 'ä'; from aegis_ot import guard\n@guard\ndef run(p): ...\n",
         ["MADE; x = 'ä'; from aegis_ot_0 import guard", "@guard"]),
        ("import aegis_ot\n@aegis_ot.guard\ndef run(p): ...\n",
         ["MADE; import aegis_ot_0 as aegis_ot", "@aegis_ot.guard"]),
    ],
)  # fmt: skip
def test_nothing_moves(text: str, first_lines: list[str]) -> None:
    wrapped = wrap(text, bundle=SMALL)
    assert wrapped.text.splitlines()[: len(first_lines)] == first_lines
    assert wrapped.moved == 0
    before = [
        node.lineno for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)
    ]
    after = ast.walk(ast.parse(wrapped.text))
    assert before == [node.lineno for node in after if isinstance(node, ast.FunctionDef)]


def test_a_definition_in_the_very_first_line_moves_and_says_so() -> None:
    wrapped = wrap("def run(p): ...", bundle=SMALL)
    assert wrapped.moved == 1
    assert wrapped.text.splitlines() == [
        "MADE", "def run(p): ...", "run = __import__('aegis_ot_0').guard(run)",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "settings", "told"),
    [
        ("def run(", {}, r"no Python: line 1: '\(' was never closed"),
        ("x = 1\n", {}, "no function run"),
        ("from aegis_ot import guard\n@guard\ndef run(p): ...\n", {"assay": "pcr"}, "Write the"),
    ],
)
def test_what_cannot_be_wrapped_is_told(text: str, settings: dict[str, str], told: str) -> None:
    with pytest.raises(ConfigurationError, match=told):
        wrap(text, settings, SMALL)


def test_the_robot_half_is_small_and_pure() -> None:
    bundle = made()
    assert len(bundle.statement) < 250_000
    assert bundle.name == make_bundle().name  # the same contents, the same name


def test_stripping_keeps_every_statement_on_its_line() -> None:
    for path in sorted((ROOT / "aegis_ot" / "runtime").glob("*.py")):
        text = path.read_text(encoding="utf-8")
        found = stripped(text)
        assert len(found) < len(text)
        lines = [
            [
                (type(node), node.lineno)
                for node in ast.walk(ast.parse(it))
                if isinstance(node, ast.stmt)
            ]
            for it in (text, found)
        ]
        assert lines[0] == lines[1]
        assert "#" not in "".join(line for line in found.splitlines() if "'" not in line)
