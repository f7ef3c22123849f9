"""A command loads what it needs, and nothing else."""

from __future__ import annotations

import subprocess
import sys
import warnings
from pathlib import Path
from typing import Annotated

import pytest

from aegis_ot.cli.app import _quiet_libraries
from aegis_ot.sidecar.store import Store
from tests.sidecar.test_store import fill

HEAVY = {"cv2", "numpy", "fastapi", "onnxruntime", "sklearn", "scipy", "matplotlib", "anthropic"}
HEAVY |= {"openai", "jinja2", "uvicorn", "opentrons", "httpx"}


def loaded_by(*arguments: str) -> set[str]:
    """The modules that a command has loaded when it ends."""
    code = (
        "import sys\n"
        f"sys.argv = ['aegis-ot', *{arguments!r}]\n"
        "from aegis_ot.cli import main\n"
        "try:\n    main()\nexcept SystemExit as end:\n    assert not end.code, end.code\n"
        "print('loaded:', *sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.rpartition("loaded:")[2].split())


def test_the_command_line_itself_loads_no_command() -> None:
    for option in ("--version", "--help"):
        loaded = loaded_by(option)
        assert not loaded & (HEAVY | {"rich.console"})
        rooms = {name.split(".")[1] for name in loaded if name.startswith("aegis_ot.")}
        assert rooms <= {"_version", "cli", "errors", "guard", "lazy", "vocabulary"}


@pytest.mark.parametrize("arguments", [("explain", "PCR-2"), ("rules", "list")])
def test_rules_are_shown_without_what_judges_by_them(arguments: tuple[str, ...]) -> None:
    loaded = loaded_by(*arguments)
    assert not loaded & (HEAVY | {"asyncio"})
    rooms = {name.split(".")[2] for name in loaded if name.startswith("aegis_ot.preflight.")}
    assert rooms == {"rule_set", "rules"}


def test_runs_are_listed_without_the_service(tmp_path: Path) -> None:
    store = Store(tmp_path)
    fill(store, "pcr", 40)
    store.close()
    assert not loaded_by("runs", "list", "--data", str(tmp_path)) & HEAVY


def test_what_one_library_says_of_another_is_kept_from_the_terminal(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pydantic = pytest.importorskip("pydantic")
    monkeypatch.setattr(sys, "warnoptions", [])
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        _quiet_libraries()
        pydantic.TypeAdapter(Annotated[int, pydantic.Field(alias="a")])
    assert told == []


def test_a_check_loads_no_library_of_cameras_services_and_models() -> None:
    assert not loaded_by("check", "--help") & HEAVY
