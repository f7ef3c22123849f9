"""Every shipped protocol simulates, and the labels beside the benchmarks fit the files."""

from __future__ import annotations

import ast
import io
import json
import logging
import re
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

simulate = pytest.importorskip("opentrons.simulate")

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = ROOT / "examples"
PROTOCOLS = ROOT / "tests" / "protocols"
FAMILIES = {"pcr", "serial_dilution", "bradford", "cell_treatment", "generic"}
RULES = {
    *(f"PCR-{n}" for n in range(1, 7)),
    *(f"SD-{n}" for n in range(1, 6)),
    *(f"BRD-{n}" for n in range(1, 5)),
    *(f"CELL-{n}" for n in range(1, 5)),
    *(f"GEN-{n}" for n in range(1, 4)),
}
WELL = re.compile(r"^.+:[A-P][0-9]{1,2}$")


def protocols(*folders: Path) -> list[Path]:
    return [path for folder in folders for path in sorted(folder.glob("*.py"))]


def short(path: Path) -> str:
    return str(path.relative_to(ROOT))


def meta(path: Path) -> dict[str, Any]:
    """The literal ``metadata`` and ``requirements`` of a protocol, merged."""
    found: dict[str, Any] = {}
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign):
            names = {target.id for target in node.targets if isinstance(target, ast.Name)}
            if names & {"metadata", "requirements"}:
                found.update(ast.literal_eval(node.value))
    return found


def without_guard(text: str) -> str:
    """The protocol under the guard, its line numbers kept."""
    text = re.sub(r"^from aegis_ot import guard$", "", text, flags=re.MULTILINE)
    return re.sub(r"^@guard(\(.*\))?$", "", text, flags=re.MULTILINE)


def runnable_here(path: Path) -> str:
    """Why this machine's opentrons cannot run the protocol, or nothing."""
    from opentrons import __version__
    from opentrons.protocols.api_support.definitions import MAX_SUPPORTED_VERSION

    facts = meta(path)
    level = tuple(int(part) for part in str(facts["apiLevel"]).split("."))
    if level > (MAX_SUPPORTED_VERSION.major, MAX_SUPPORTED_VERSION.minor):
        return f"apiLevel {facts['apiLevel']} is newer than opentrons {__version__}"
    if "Flex" not in facts.get("robotType", "OT-2") and int(__version__.split(".")[0]) > 9:
        return f"opentrons {__version__} no longer simulates OT-2 protocols"
    return ""


ALL = protocols(
    EXAMPLES / "benchmark",
    EXAMPLES / "benchmark-multi",
    EXAMPLES / "demo",
)
ALL += protocols(EXAMPLES / "prose-benchmark")[::10]  # all of them have been rehearsed
# Those in public style are rehearsed by tests/preflight/test_public_style.py, and those of the
# transparency set simulated by tests/compat/test_matrix.py.


@pytest.mark.parametrize("path", ALL, ids=short)
def test_simulates(path: Path) -> None:
    reason = runnable_here(path)
    if reason:
        pytest.skip(reason)
    logging.getLogger("opentrons").setLevel(logging.CRITICAL)
    text = without_guard(path.read_text(encoding="utf-8"))
    expected = re.search(r"^# raises: (.+)$", text, flags=re.MULTILINE)
    modules = set(sys.modules)
    if expected:
        with pytest.raises(Exception, match=expected[1]):
            simulate.simulate(io.StringIO(text), file_name=path.name)
    else:
        runlog, _ = simulate.simulate(io.StringIO(text), file_name=path.name)
        assert len(runlog) > 3
    assert not {name for name in set(sys.modules) - modules if name.startswith("aegis_ot")}


def labels(folder: Path) -> list[dict[str, Any]]:
    loaded: list[dict[str, Any]] = json.loads((folder / "labels.json").read_text(encoding="utf-8"))
    return loaded


@pytest.mark.parametrize("folder", ["benchmark", "benchmark-multi", "prose-benchmark"])
def test_labels_fit_the_files(folder: str) -> None:
    here = EXAMPLES / folder
    entries = labels(here)
    assert sorted(entry["file"] for entry in entries) == [p.name for p in protocols(here)]
    for entry in entries:
        name = entry["file"]
        source = (here / name).read_text(encoding="utf-8").splitlines()
        assert entry["family"] in FAMILIES, name
        assert entry["verdict"] in {"pass", "fail"}, name
        assert set(entry["rules"]) | set(entry["also_acceptable"]) <= RULES, name
        assert set(entry["wells"]) == set(entry["lines"]) == set(entry["rules"]), name
        assert bool(entry["rules"]) == ("fail" in (entry["verdict"], entry.get("adjusted_verdict")))
        assert entry["note"], name
        for rule in entry["rules"]:
            assert entry["wells"][rule], (name, rule)
            assert all(WELL.match(well) for well in entry["wells"][rule]), (name, rule)
            for line in entry["lines"][rule]:
                assert re.search(r"\.\w+\(|\w+\(", source[line - 1]), (name, rule, line)


def test_benchmark_has_the_papers_shape() -> None:
    entries = labels(EXAMPLES / "benchmark")
    assert Counter(entry["verdict"] for entry in entries) == {"pass": 11, "fail": 13}
    assert {entry["family"] for entry in entries} == FAMILIES
    failing = [entry for entry in entries if entry["verdict"] == "fail"]
    assert all(len(entry["rules"]) == 1 for entry in failing)
    assert len({entry["rules"][0] for entry in failing}) >= 12
    adjusted = [entry for entry in entries if "adjusted_verdict" in entry]
    assert [entry["rules"] for entry in adjusted] == [["SD-5"], ["SD-5"]]
    multi = labels(EXAMPLES / "benchmark-multi")
    assert len(multi) == 3
    assert sum(len(entry["rules"]) for entry in multi) == 8


def test_demo_has_a_real_length_protocol() -> None:
    path = EXAMPLES / "demo" / "normalisation_plate.py"
    text = without_guard(path.read_text(encoding="utf-8"))
    runlog, _ = simulate.simulate(io.StringIO(text), file_name=path.name)
    lines = [str(entry["payload"].get("text", "")) for entry in runlog]
    filled = {m[1] for line in lines if (m := re.search(r"Dispensing .* into (\w+) of Norm", line))}
    assert len(filled) >= 48


def test_public_style_expectations_fit_the_files() -> None:
    here = PROTOCOLS / "public_style"
    expected = json.loads((here / "expected.json").read_text(encoding="utf-8"))
    assert sorted(expected) == [path.name for path in protocols(here)]
    for name, entry in expected.items():
        assert set(entry["may_fire"]) <= RULES, name
        assert entry["note"], name


def test_transparency_set_is_varied() -> None:
    facts = [meta(path) for path in protocols(PROTOCOLS / "transparency")]
    flex = [fact for fact in facts if fact.get("robotType") == "Flex"]
    ot2_levels = {fact["apiLevel"] for fact in facts if fact.get("robotType") != "Flex"}
    assert len(facts) >= 24
    assert len(flex) >= 6
    assert ot2_levels >= {
        "2.0", "2.2", "2.7", "2.12", "2.13", "2.14", "2.16", "2.20", "2.22", "2.24", "2.27",
    }  # fmt: skip
