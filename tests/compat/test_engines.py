"""A shelf of all versions is judged in one call, by a command line that has no ``opentrons``.

The engines are the environments of the matrix; that an engine can be made is tried where the
registry can be reached.
"""

from __future__ import annotations

import json
import os
import shutil
import zipfile
from pathlib import Path

import pytest

pytest.importorskip("tomllib")

from aegis_ot.errors import ConfigurationError
from aegis_ot.workbench import engine_making
from aegis_ot.workbench.engine_making import install, remove

from .environments import MATRIX
from .test_extras import Environment

OT2 = """
requirements = {{"robotType": "OT-2", "apiLevel": "{level}"}}
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    pipette.transfer(50, plate["A1"], plate["B1"])
"""
FLEX = """
requirements = {{"robotType": "Flex", "apiLevel": "{level}"}}
def run(protocol):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "C2")
    protocol.load_trash_bin("A3")
    pipette = protocol.load_instrument("flex_1channel_1000", "left", [tips])
    pipette.transfer(50, plate["A1"], plate["B1"])
"""


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_a_mixed_shelf_is_judged_in_one_call(tmp_path: Path) -> None:
    engines = tmp_path / "engines"
    engines.mkdir()
    for name in ("py310-ot8", "py311-ot9", "py312-ot10"):
        (environment,) = (one for one in MATRIX if one.name == name)
        if not environment.ready:
            pytest.skip(f"{name} is not there; `make matrix` makes it")
        folder = environment.interpreter.parents[1]
        (version,) = folder.glob("lib/python*/site-packages/opentrons-*.dist-info")
        (engines / version.name.split("-")[1].removesuffix(".dist")).symlink_to(folder)
    shelf = tmp_path / "shelf"
    shelf.mkdir()
    levels = {"OT-2": ("2.15", "2.27", "2.28"), "Flex": ("2.16", "2.28", "2.29", "2.31")}
    for robot, text in (("OT-2", OT2), ("Flex", FLEX)):
        for level in levels[robot]:
            (shelf / f"{robot}-{level}.py").write_text(text.format(level=level))
    alone = Environment(tmp_path / "alone", "check")
    done = alone("check", "--format", "json", str(shelf), AEGIS_OT_ENGINES=str(engines))
    assert done.returncode == 0, done.stdout + done.stderr
    told = json.loads(done.stdout)["protocols"]
    assert len(told) == 7
    used = {Path(one["file"]).stem: one["notes"][0].split()[-1] for one in told}
    assert used["OT-2-2.15"].startswith("8.8.")
    assert used["OT-2-2.28"] == used["Flex-2.28"] == "9.0.0."
    assert used["Flex-2.29"] == used["Flex-2.31"]
    assert used["Flex-2.31"].startswith("10.")


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_an_engine_is_made_and_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AEGIS_OT_ENGINES", str(tmp_path / "engines"))
    try:
        engine = install("9.0.0")
    except ConfigurationError as error:
        pytest.skip(f"the registry cannot be reached: {error}")
    assert engine.newest == (2, 28)
    assert os.access(engine.python, os.X_OK)
    remove("9.0.0")
    assert list((tmp_path / "engines").iterdir()) == []


def write_wheel(folder: Path, name: str, version: str, files: dict[str, str]) -> None:
    about = f"{name}-{version}.dist-info"
    files = files | {
        f"{about}/METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n",
        f"{about}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    record = "".join(f"{file},,\n" for file in [*files, f"{about}/RECORD"])
    with zipfile.ZipFile(folder / f"{name}-{version}-py3-none-any.whl", "w") as wheel:
        for file, text in (files | {f"{about}/RECORD": record}).items():
            wheel.writestr(file, text)


@pytest.mark.timeout(300)
def test_without_uv_pip_makes_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is installed is a stand-in, so that nothing is downloaded a second time."""
    level = "MAX_SUPPORTED_VERSION = APIVersion(2, 28)\n"
    write_wheel(
        tmp_path, "opentrons", "9.0.0", {"opentrons/protocols/api_support/definitions.py": level}
    )
    write_wheel(tmp_path, "pandas", "2.2", {"pandas.py": ""})
    monkeypatch.setenv("AEGIS_OT_ENGINES", str(tmp_path / "engines"))
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path))
    which = shutil.which
    monkeypatch.setattr(
        engine_making.shutil,
        "which",
        lambda name, **at: None if name == "uv" else which(name, **at),
    )
    engine = install("9.0.0")
    assert (engine.version, engine.newest) == ("9.0.0", (2, 28))
    with pytest.raises(ConfigurationError, match="No matching distribution found for nothing"):
        install("9.0.0", ["nothing-of-this-name"])
