"""Which opentrons rehearses a protocol, and what is said where none here does."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.preflight import load_rules
from aegis_ot.workbench import CheckSettings, check_files, engine_making
from aegis_ot.workbench.engine_making import install, remove
from aegis_ot.workbench.engines import (
    Engine,
    EngineMissing,
    Need,
    engine_for,
    here,
    installed,
    need_of,
)

TRANSFER = """
requirements = {{"robotType": "{robot}", "apiLevel": "{level}"}}
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    pipette.transfer(50, plate["A1"], plate["B1"])
"""


@pytest.fixture
def engines(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of engines, empty."""
    folder = tmp_path / "engines"
    monkeypatch.setenv("AEGIS_OT_ENGINES", str(folder))
    return folder


def put(folder: Path, version: str, newest: str, python: str = "") -> None:
    """What is seen of an engine; with another one's interpreter it works as well."""
    site = folder / version / "lib/python3.11/site-packages"
    (site / "opentrons/protocols/api_support").mkdir(parents=True)
    (site / f"opentrons-{version}.dist-info").mkdir()
    text = f"MAX_SUPPORTED_VERSION = APIVersion({newest.replace('.', ', ')})\n"
    (site / "opentrons/protocols/api_support/definitions.py").write_text(text)
    if python:
        (folder / version / "bin").mkdir()
        script = folder / version / "bin/python"
        script.write_text(f'#!/bin/sh\nexec {python} "$@"\n')
        script.chmod(0o755)


@pytest.mark.parametrize(
    ("text", "need"),
    [
        ('metadata = {"apiLevel": "2.9"}', Need("OT-2", (2, 9))),
        ('metadata = {"apiLevel": "2.9"}\nrequirements = {"robotType": "OT-2"}',
         Need("OT-2", (2, 9))),
        ('requirements = {"robotType": "OT-3", "apiLevel": "2.29"}', Need("Flex", (2, 29))),
        ('metadata = {"apiLevel": level()}', None),
        ("metadata = {", None),
        ("", None),
    ],
)  # fmt: skip
def test_a_protocol_declares_its_robot_and_level(text: str, need: Need | None) -> None:
    assert need_of(text) == need


def test_the_environment_one_stands_in_serves_where_it_fits(engines: Path) -> None:
    own = here()
    assert own is not None
    put(engines, "9.0.0", "2.28")
    put(engines, "10.1.0", "2.31")
    assert engine_for(Need("OT-2", (2, 13))) == own
    assert engine_for(None) == own
    assert engine_for(Need("OT-2", (2, 28))).version == "9.0.0"
    assert engine_for(Need("Flex", (2, 28))).version == "9.0.0"
    assert engine_for(Need("Flex", (2, 31))).version == "10.1.0"
    # A robot that is named goes first.
    assert engine_for(Need("Flex", (2, 20)), "10.1.0").version == "10.1.0"
    assert engine_for(Need("OT-2", (2, 20)), "10.1.0") == own


def test_a_missing_engine_is_one_sentence_with_the_line_to_type(
    engines: Path, tmp_path: Path
) -> None:
    put(engines, "10.1.0", "2.31")
    with pytest.raises(EngineMissing) as missing:
        engine_for(Need("OT-2", (2, 28)))
    assert missing.value.version == "9.0.0"
    protocol = tmp_path / "newer.py"
    protocol.write_text(TRANSFER.format(robot="OT-2", level="2.28"))
    run = check_files([protocol], CheckSettings(), load_rules())
    assert run.exit_code == 2
    problem = run.protocols[0].problem
    assert problem is not None
    assert problem.message.endswith("type: aegis-ot engines install 9.0.0")
    assert "(OT-2, apiLevel 2.28)" in problem.message


def test_a_level_that_nobody_knows_yet_says_so(engines: Path) -> None:
    with pytest.raises(EngineMissing, match=r"apiLevel 2\.40, which no engine.*ends at 2\.28") as m:
        engine_for(Need("OT-2", (2, 40)))
    assert m.value.version == ""
    with pytest.raises(EngineMissing, match=r"Flex ends at 2\.31"):
        engine_for(Need("Flex", (2, 40)))


def test_no_release_is_taken_for_a_robot_that_it_refuses() -> None:
    assert Engine("8.2.0", (2, 21)).robots == ("OT-2",)
    assert Engine("8.8.2", (2, 27)).robots == Engine("9.0.0", (2, 28)).robots == ("OT-2", "Flex")
    assert Engine("9.1.2", (2, 29)).robots == Engine("10.1.0", (2, 31)).robots == ("Flex",)


def test_an_engine_judges_with_this_package_alone_lent_to_it(
    engines: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its interpreter is this one's: what is tested is the way there and back."""
    put(engines, "9.0.0", "2.28", sys.executable)
    monkeypatch.setattr("aegis_ot.workbench.engines.here", lambda: None)
    protocol = tmp_path / "plain.py"
    protocol.write_text(TRANSFER.format(robot="OT-2", level="2.20"))
    # A module of the working folder is none of the rehearsal's.
    monkeypatch.chdir(tmp_path)
    (tmp_path / "json.py").write_text("raise SystemExit('mine')")
    run = check_files([protocol], CheckSettings(), load_rules())
    report = run.protocols[0].report
    assert report is not None, run.protocols[0].problem
    assert "rehearsed with opentrons 9.0.0." in report.notes
    protocol.write_text("import polars\n" + TRANSFER.format(robot="OT-2", level="2.20"))
    problem = check_files([protocol], CheckSettings(), load_rules()).protocols[0].problem
    assert problem is not None
    assert "aegis-ot engines install 9.0.0 --with polars" in problem.message


def test_an_engine_that_is_broken_keeps_its_own_protocols_from_being_judged(
    engines: Path, tmp_path: Path
) -> None:
    put(engines, "9.0.0", "2.28", "/nowhere/python")
    files = [tmp_path / "newer.py", tmp_path / "older.py"]
    for file, level in zip(files, ("2.28", "2.20"), strict=True):
        file.write_text(TRANSFER.format(robot="OT-2", level=level))
    newer, older = check_files(files, CheckSettings(), load_rules()).protocols
    assert newer.problem is not None
    assert "Type: aegis-ot engines remove 9.0.0, and install it again" in newer.problem.message
    assert older.report is not None


def test_what_is_no_version_and_what_is_not_there(engines: Path) -> None:
    with pytest.raises(ConfigurationError, match=r"write it as 9\.0\.0"):
        install("../9.0.0")
    put(engines, "9.0.0", "2.28")
    with pytest.raises(ConfigurationError, match=r"no engine 8\.2\.0; installed: 9\.0\.0"):
        remove("8.2.0")
    remove("9.0.0")
    assert installed() == []


def test_what_an_installer_says_is_told_without_its_list_of_versions() -> None:
    said = "WARNING: no place\\nERROR: nothing fits opentrons==99 (from versions: 1.0, 2.0)"
    command = [sys.executable, "-c", f"import sys; sys.exit('{said}')"]
    with pytest.raises(ConfigurationError, match=r"ERROR: nothing fits opentrons==99$"):
        engine_making._call(command)


def test_half_an_engine_is_made_anew(engines: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    half = engine_making.python_in(engines / "9.0.0")
    half.parent.mkdir(parents=True)
    half.touch()

    def make(folder: Path, uv: str | None, version: str) -> None:
        put(engines / "elsewhere", version, "2.28")
        (engines / "elsewhere" / version).rename(folder)

    monkeypatch.setattr(engine_making, "_make", make)
    monkeypatch.setattr(engine_making, "_put_into", lambda *_: None)
    assert install("9.0.0").version == "9.0.0"
