"""The support matrix: which Python with which ``opentrons``, and where the environments are.

``python -m tests.compat.environments`` makes the missing ones under ``.venvs`` (each holds
nothing but ``opentrons`` and what it needs) and says what it left out and why.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / ".venvs"


@dataclass(frozen=True)
class Environment:
    """One cell of the matrix.

    Attributes:
        name: Of its folder.
        python: ``"3.10"``.
        opentrons: Requirement.
        robots: Prefixes of the protocols that this release simulates.
        newest: The last apiLevel that it knows, 2.N.
        instead: Requirements in place of those of opentrons.
        every: Of the protocols each so-manieth is run, unless ``AEGIS_OT_FULL`` is set: another
            environment has this release too, or a newer and an older one have run them all.
    """

    name: str
    python: str
    opentrons: str
    robots: tuple[str, ...] = ("ot2", "flex")
    newest: int = 99
    instead: tuple[str, ...] = ()
    every: int = 1

    @property
    def interpreter(self) -> Path:
        return FOLDER / self.name / "bin" / "python"

    @property
    def ready(self) -> bool:
        return (FOLDER / self.name / ".installed").exists()

    def base(self) -> str | None:
        """An interpreter of this version on this machine, ``None`` if there is none."""
        found = shutil.which(f"python{self.python}")
        if found and _runs(found, self.python):
            return found
        pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
        for candidate in sorted(pyenv.glob(f"{self.python}.*/bin/python")):
            if _runs(str(candidate), self.python):
                return str(candidate)
        return None

    def make(self) -> str:
        """Make it if need be; one line on what was done."""
        if self.ready:
            return f"{self.name}: ready"
        base = self.base()
        if base is None:
            return f"{self.name}: left out, no Python {self.python} here"
        folder, instead = FOLDER / self.name, FOLDER / f"{self.name}.txt"
        uv(["venv", "--clear", "--python", base, folder])
        instead.write_text("\n".join(self.instead), encoding="utf-8")
        install = ["pip", "install", "--python", self.interpreter, "--override", instead]
        uv([*install, self.opentrons, *self.instead])
        (FOLDER / self.name / ".installed").touch()
        return f"{self.name}: made with Python {self.python} and {self.opentrons}"


def uv(arguments: list[str | Path]) -> None:
    """Call uv, which the extra ``dev`` brings."""
    subprocess.run([sys.executable, "-m", "uv", "--quiet", *arguments], check=True)


def _runs(python: str, version: str) -> bool:
    """A pyenv shim can stand for a version that is not selected."""
    asked = "import sys; print('%d.%d' % sys.version_info[:2])"
    done = subprocess.run([python, "-c", asked], capture_output=True, text=True, check=False)
    return done.returncode == 0 and done.stdout.strip() == version


MATRIX = (
    # As on many an OT-2: pydantic 1, and an engine that knows no later commands.
    Environment("py310-ot82", "3.10", "opentrons==8.2.0", robots=("ot2",), newest=21),
    Environment("py310-ot8", "3.10", "opentrons==8.8.2", newest=27),
    # opentrons asks for a numpy that no wheel for 3.13 has; compiling it takes minutes.
    Environment(
        "py313-ot8", "3.13", "opentrons==8.8.2", newest=27, instead=("numpy>=2.1,<2.4",), every=3
    ),
    Environment("py311-ot9", "3.11", "opentrons==9.0.0", newest=28, every=3),
    Environment("py312-ot10", "3.12", "opentrons>=10,<11", robots=("flex",)),
)


def main() -> int:
    FOLDER.mkdir(exist_ok=True)
    with ThreadPoolExecutor(2) as pool:
        for line in pool.map(Environment.make, MATRIX):
            print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
