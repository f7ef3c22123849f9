"""Each extra brings what its commands need; without it, one sentence says what to install."""

from __future__ import annotations

import atexit
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

pytest.importorskip("tomllib")

from .extras import ROOT, make_environment

pytestmark = pytest.mark.timeout(600)  # each environment is made anew, beside other tests

GUARDED = "examples/demo/hello_guard.py"
HEAVY = {"cv2", "onnxruntime", "sklearn", "jinja2", "matplotlib", "fastapi", "scipy", "torch"}


class Environment:
    """Calls ``aegis-ot`` with what some extras bring."""

    def __init__(self, folder: Path, *extras: str) -> None:
        self._python = make_environment(folder, extras)
        # A rehearsing process of this environment serves its later commands: a socket's path is
        # short.
        self._sockets = tempfile.mkdtemp(prefix="aegis-")
        atexit.register(shutil.rmtree, self._sockets, ignore_errors=True)

    def __call__(self, *arguments: str, **environ: str) -> subprocess.CompletedProcess[str]:
        kept = {k: v for k, v in os.environ.items() if not k.startswith(("AEGIS_OT_", "PYTHON"))}
        kept |= {"AEGIS_OT_WARM": "30", "XDG_RUNTIME_DIR": self._sockets}
        kept["XDG_DATA_HOME"] = str(self._python.parent.parent / "data")  # nobody's engines
        return subprocess.run(
            [str(self._python), "-m", "aegis_ot", *arguments],
            capture_output=True, text=True, cwd=ROOT, env=kept | environ, timeout=600, check=False,
        )  # fmt: skip

    def has(self, *modules: str) -> set[str]:
        code = (
            f"from importlib.util import find_spec; print([m for m in {modules} if find_spec(m)])"
        )
        done = subprocess.run(
            [self._python, "-c", code], capture_output=True, text=True, check=True
        )
        return set(eval(done.stdout))

    def starts(self) -> None:
        for option in ("--help", "--version"):
            done = self(option)
            assert (done.returncode, done.stderr) == (0, "")

    def asks_for(self, extra: str, *arguments: str) -> None:
        done = self(*arguments)
        assert done.returncode == 2, done.stdout + done.stderr
        assert f"'aegis-ot[{extra}]'" in done.stderr
        assert done.stderr.count("\n") == 1, done.stderr


@pytest.fixture(scope="module")
def check(tmp_path_factory: pytest.TempPathFactory) -> Environment:
    return Environment(tmp_path_factory.mktemp("check"), "check", "ot2")


@pytest.fixture(scope="module")
def sidecar(tmp_path_factory: pytest.TempPathFactory) -> Environment:
    return Environment(tmp_path_factory.mktemp("sidecar"), "sidecar", "ot2")


def test_without_an_extra_the_command_line_says_what_to_install(tmp_path: Path) -> None:
    Environment(tmp_path).asks_for("check", "--version")


def test_without_opentrons_a_check_says_what_to_install(tmp_path: Path) -> None:
    alone = Environment(tmp_path, "check")
    alone.starts()
    assert alone("explain", "PCR-2").returncode == 0
    assert alone("rules", "list").returncode == 0
    done = alone("check", GUARDED)
    assert done.returncode == 2
    assert "type: aegis-ot engines install 8.8.2" in done.stdout + done.stderr


def test_check_is_layer_1_alone(check: Environment) -> None:
    assert check.has(*HEAVY) == set()
    check.starts()
    done = check("check", GUARDED)
    assert (done.returncode, done.stderr) == (0, "")
    assert check("rules", "test", "--select", "GEN-1").returncode == 0


@pytest.mark.parametrize(
    ("extra", "arguments"),
    [
        ("sidecar", ("check", "--format", "html", GUARDED)),
        ("sidecar", ("simulate", GUARDED)),
        ("sidecar", ("sidecar", "--camera", "pattern")),
        ("sidecar", ("doctor",)),
        ("sidecar", ("run", GUARDED, "--robot", "127.0.0.1")),
        ("fleet", ("fleet", "run", "--robots", "fleet.toml", GUARDED)),
        ("editor", ("lsp",)),
        ("lab", ("evaluate", "layer2", "somewhere")),
        ("lab", ("reproduce", "--out", "out")),
        ("lab", ("dataset", "simulate", "somewhere")),
    ],
    ids=lambda value: value if isinstance(value, str) else value[0],
)
def test_what_check_does_not_bring_is_named(
    check: Environment, extra: str, arguments: tuple[str, ...]
) -> None:
    check.asks_for(extra, *arguments)


def test_llm_asks_a_model(tmp_path: Path) -> None:
    asking = Environment(tmp_path, "check", "ot2", "llm")
    asking.starts()
    done = asking("check", GUARDED, "--model", "openai:m@http://127.0.0.1:9/v1#attempts=1")
    assert done.returncode == 2, "nobody answers there"
    assert "pip install" not in done.stdout + done.stderr


def test_sidecar_watches_a_run(sidecar: Environment, check: Environment, tmp_path: Path) -> None:
    assert sidecar.has("sklearn", "matplotlib", "torch") == set()
    sidecar.starts()
    data = str(tmp_path / "data")
    done = sidecar("simulate", GUARDED, "--data", data)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "hello_guard.py" in sidecar("runs", "list", "--data", data).stdout
    assert "hello_guard.py" in check("runs", "list", "--data", data).stdout, "it needs no more"


def test_what_sidecar_does_not_bring_is_named(sidecar: Environment, tmp_path: Path) -> None:
    drawn = str(tmp_path / "drawn")
    assert (
        sidecar("dataset", "simulate", drawn, "--plates", "2", "--size", "320x240").returncode == 0
    )
    sidecar.asks_for("lab", "evaluate", "layer2", drawn, "--scorer", "one-class-svm")
    sidecar.asks_for("train", "train", "detector", "--out", str(tmp_path / "d"))


def test_fleet_runs_a_fleet(tmp_path: Path) -> None:
    fleet = Environment(tmp_path / "venv", "fleet", "ot2")
    fleet.starts()
    robots = tmp_path / "fleet.toml"
    pipettes = 'pipettes = {right = "p300_single_gen2"}'
    robots.write_text(f'[[robot]]\nname = "a"\n{pipettes}\n', encoding="utf-8")
    done = fleet("fleet", "run", "--robots", str(robots), GUARDED)
    assert "1 of 1 protocol clean" in done.stdout, done.stdout + done.stderr


def test_lab_measures(tmp_path: Path) -> None:
    lab = Environment(tmp_path / "venv", "lab", "ot2")
    lab.starts()
    drawn, figures = str(tmp_path / "drawn"), tmp_path / "figures"
    assert lab("dataset", "simulate", drawn, "--plates", "2", "--size", "320x240").returncode == 0
    done = lab("evaluate", "layer2", drawn, "--scorer", "pca,one-class-svm", "--boxes", "true",
               "--figures", str(figures))  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert list(figures.glob("*.png"))
