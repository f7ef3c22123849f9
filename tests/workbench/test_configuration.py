from __future__ import annotations

import sys
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.workbench import Configuration, configurations_of
from aegis_ot.workbench.configuration import ConfiguredWaiver, find_configuration

pytest.importorskip("tomllib")

FULL = """
[tool.aegis-ot]
assay = "pcr"
select = ["PCR-1", "pcr-6"]
ignore = "GEN-3"
rules = ["ours"]
labware = ["labware"]
baseline = "known.json"
timeout = 30

[tool.aegis-ot.severity]
PCR-6 = "error"

[[tool.aegis-ot.waivers]]
rules = ["SD-5"]
files = ["tutorials/*.py"]
reason = "One tip is how we teach it."
"""


def _write(folder: Path, text: str) -> Path:
    (folder / "pyproject.toml").write_text(text, encoding="utf-8")
    return folder


def test_everything_is_read_and_paths_are_relative_to_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    below = _write(tmp_path, FULL) / "protocols" / "pcr"
    below.mkdir(parents=True)
    monkeypatch.chdir(below)
    assert find_configuration(below) == Configuration(
        assay=("pcr",),
        select=("PCR-1", "PCR-6"),
        ignore=("GEN-3",),
        rules=(str(tmp_path / "ours"),),
        labware=(str(tmp_path / "labware"),),
        baseline=str(tmp_path / "known.json"),
        timeout=30.0,
        severity={"PCR-6": "error"},
        waivers=(ConfiguredWaiver(("SD-5",), "One tip is how we teach it.", ("tutorials/*.py",)),),
        folder=tmp_path,
        name="../../pyproject.toml",
    )


def test_each_protocol_goes_by_the_nearest_table_else_by_the_working_folders(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    here, there, bare = (tmp_path / name for name in ("here", "there", "bare"))
    for folder in (here, there / "sub", bare):
        folder.mkdir(parents=True)
    _write(here, "[tool.aegis-ot]\nassay = 'pcr'\n")
    _write(there, "[tool.aegis-ot]\nassay = 'bradford'\n")
    _write(there / "sub", "[project]\nname = 'x'\n")
    monkeypatch.chdir(here)
    files = [Path("../bare/a.py"), there / "sub" / "b.py", Path("c.py"), there / "d.py"]
    found = configurations_of(files, Path.cwd())
    assert [(configured.assay, own) for configured, own in found] == [
        (("pcr",), [files[0], files[2]]),
        (("bradford",), [files[1], files[3]]),
    ]
    assert [configured.name for configured, _ in found] == [
        "pyproject.toml",
        "../there/pyproject.toml",
    ]


def test_no_table_anywhere_is_one_empty_configuration(tmp_path: Path) -> None:
    found = configurations_of([tmp_path / "a.py", Path("no such folder/b.py")], tmp_path)
    assert found == [(Configuration(), [tmp_path / "a.py", Path("no such folder/b.py")])]


def test_a_file_without_the_table_is_passed_over(tmp_path: Path) -> None:
    inner = _write(tmp_path, FULL) / "inner"
    inner.mkdir()
    _write(inner, "[project]\nname = 'x'\n")
    assert find_configuration(inner).assay == ("pcr",)


@pytest.mark.parametrize(
    "text",
    [
        '[tool."aegis-ot"]\nassay = "pcr"\n',
        '[ tool . aegis-ot ]\nassay = "pcr"\n',
        '[tool]\naegis-ot.assay = "pcr"\n',
    ],
)
@pytest.mark.skipif(sys.version_info < (3, 11), reason="Python 3.10 reads no TOML")
def test_every_way_to_write_the_table_is_read(tmp_path: Path, text: str) -> None:
    assert find_configuration(_write(tmp_path, text)).assay == ("pcr",)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("asay = 'pcr'", "no key 'asay'"),
        ("select = 3", "select: expected a list"),
        ("timeout = 'long'", "timeout: expected a number"),
        ("timeout = -1", "timeout: must be greater"),
        ("baseline = 3", "baseline: expected a path"),
        ("severity = {PCR-1 = 'fatal'}", "severity.PCR-1: expected error, warning or off"),
        ("waivers = [{rules = ['SD-5']}]", "gives no reason for waiving SD-5"),
        ("waivers = [{rules = ['SD-5'], reason = ' .'}]", "gives no reason for waiving SD-5"),
        ("waivers = [{reason = 'because'}]", "names no rules"),
        ("waivers = 'SD-5'", "write each as"),
        ("= 3", "is not TOML"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(tmp_path: Path, table: str, words: str) -> None:
    _write(tmp_path, f"[tool.aegis-ot]\n{table}\n")
    with pytest.raises(ConfigurationError) as caught:
        find_configuration(tmp_path)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
