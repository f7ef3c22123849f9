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
RUN = """
import io, json, logging, sys
logging.disable(logging.CRITICAL)
import opentrons.simulate as simulate

class Blocked:  # whatever opentrons has not brought along already
    known = {name.partition(".")[0] for name in sys.modules} | set(sys.stdlib_module_names)

    def find_spec(self, name, path=None, target=None):
        root = name.partition(".")[0]
        if root not in self.known and not root.startswith("aegis_ot_"):
            raise ImportError(f"{name} is no part of Python or opentrons")

sys.meta_path.insert(0, Blocked())
text = open(sys.argv[1]).read()
found = []
for _ in range(2):
    try:
        log, _ = simulate.simulate(io.StringIO(text), "protocol.py", log_level="none")
        found.append([entry["payload"].get("text", "") for entry in log])
    except Exception as error:
        found.append(str(error))
mine = sorted(name for name in sys.modules if name.startswith("aegis"))
print("FOUND", json.dumps({"runs": found, "modules": mine}))
"""


def alone(text: str, folder: Path, python: str | Path = sys.executable) -> dict[str, object]:
    """Simulate twice in a fresh interpreter that has no aegis_ot."""
    path = folder / "protocol.py"
    path.write_text(text, encoding="utf-8")
    bare = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    hidden = "import sys; sys.modules['aegis_ot'] = None\n"  # importing it would fail
    done = subprocess.run(
        [str(python), "-c", hidden + RUN, str(path)],
        capture_output=True, text=True, cwd=folder, env=bare, check=False,
    )  # fmt: skip
    assert "FOUND " in done.stdout, done.stderr[-3000:]
    return dict(json.loads(done.stdout.rpartition("FOUND ")[2]))


def test_an_unguarded_protocol_is_guarded_and_does_the_same(tmp_path: Path) -> None:
    plain = alone(SAFE, tmp_path)["runs"]
    told = alone(wrap(SAFE, {"assay": "generic"}, made()).text, tmp_path)
    for before, after in zip(plain, told["runs"], strict=True):  # type: ignore[call-overload]
        assert [line for line in after if not line.startswith("aegis_ot: ")] == before
        assert after[-1].startswith("aegis_ot: Layer 1: ")


def test_a_guarded_protocol_finds_the_guard_inside(tmp_path: Path) -> None:
    text = (ROOT / "examples" / "demo" / "pcr_setup_contaminated.py").read_text(encoding="utf-8")
    wrapped = wrap(text, bundle=made())
    assert wrapped.guarded_before
    told = alone(wrapped.text, tmp_path)["runs"]
    assert all("Layer 1 found" in run for run in told)  # type: ignore[attr-defined]
    # The lines of the findings are the original's.
    lines = text.splitlines()
    assert len(wrapped.text.splitlines()) == len(lines)
    assert "ProtocolRejected [line " in told[0]  # type: ignore[index]


def test_findings_and_errors_keep_their_lines(tmp_path: Path) -> None:
    text = SAFE + '    raise ValueError("here")\n'
    line = len(text.splitlines())
    told = alone(wrap(text, bundle=made()).text, tmp_path)["runs"]
    assert f"ValueError [line {line}]: here" in told[0]  # type: ignore[index]


@pytest.mark.parametrize("environment", MATRIX, ids=lambda e: e.name)
def test_it_runs_where_there_is_nothing_but_opentrons(environment, tmp_path):  # type: ignore[no-untyped-def]
    if not environment.ready or "ot2" not in environment.robots:
        pytest.skip(f"{environment.name} is not there, or simulates no OT-2")
    told = alone(wrap(SAFE, bundle=made()).text, tmp_path, environment.interpreter)["runs"]
    assert told[0][-1].startswith("aegis_ot: Layer 1: ")  # type: ignore[index]


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
        ("def run(", {}, "no Python"),
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
