"""Makes engines: environments with one release of ``opentrons``, by uv where it is installed."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Sequence
from importlib.util import find_spec
from pathlib import Path

from ..errors import ConfigurationError
from .engines import (
    Engine,
    EngineMissing,
    Need,
    engine_for,
    engines_folder,
    installed,
    python_in,
    release_of,
)

_VERSION = re.compile(r"\d+\.\d+\.\d+\w*")
_VERSIONS = re.compile(r" ?\(from versions: [^)]*\)|WARNING:.*?(?=ERROR:)")
_ON_ROBOTS = ("pandas<3",)
"""What robots come with beside ``opentrons``, and protocols import."""
_LONGEST_S = 1800.0


def install(version: str, packages: Sequence[str] = ()) -> Engine:
    """Make an engine; into one that is there, only the packages are put.

    Args:
        version: Of ``opentrons``.
        packages: What protocols import besides, as for pip.

    Raises:
        ConfigurationError: It cannot be made; with the last words of what failed.
    """
    if not _VERSION.fullmatch(version):
        raise ConfigurationError(f"{version!r} is no version of opentrons; write it as 9.0.0.")
    uv = shutil.which("uv") or shutil.which("uv", path=str(Path(sys.executable).parent))
    final = engines_folder() / version
    if python_in(final).exists() and any(one.folder == final for one in installed()):
        _put_into(final, uv, packages)
        return _made(version)
    shutil.rmtree(final, ignore_errors=True)  # half an engine: its removal was interrupted
    making = engines_folder() / f".making-{version}-{os.getpid()}"
    try:
        making.parent.mkdir(parents=True, exist_ok=True)
        _make(making, uv, version)
        _put_into(making, uv, [f"opentrons=={version}", *_ON_ROBOTS, *packages])
        if not final.exists():  # else another call was quicker
            making.rename(final)
    except OSError as error:
        raise ConfigurationError(f"The engine cannot be made in {making}: {error}.") from None
    finally:
        shutil.rmtree(making, ignore_errors=True)
    return _made(version)


def install_for(needs: Iterable[Need | None]) -> list[Engine]:
    """Make what lacks for such protocols; what no engine serves is told when it is judged."""
    made = []
    for need in needs:
        try:
            engine_for(need)
        except EngineMissing as missing:
            if missing.version:
                made.append(install(missing.version))
    return made


def remove(version: str) -> None:
    """Remove an engine.

    Raises:
        ConfigurationError: There is none of this version, or it cannot be removed.
    """
    for engine in installed():
        if engine.version == version and engine.folder is not None:
            try:
                shutil.rmtree(engine.folder)
            except OSError as error:
                raise ConfigurationError(f"{engine.folder} cannot be removed: {error}.") from None
            return
    there = ", ".join(engine.version for engine in installed()) or "none"
    raise ConfigurationError(f"There is no engine {version}; installed: {there}.")


def _made(version: str) -> Engine:
    for engine in installed():
        if engine.version == version:
            return engine
    raise ConfigurationError(f"{engines_folder() / version} holds no opentrons {version}.")


def _make(folder: Path, uv: str | None, version: str) -> None:
    wanted = _pythons(version)
    python = next(filter(None, map(_interpreter, wanted)), None)
    if uv:
        _call([uv, "venv", "--quiet", "--python", python or wanted[0], folder])
    elif python is None:
        raise ConfigurationError(
            f"opentrons {version} needs Python {' or '.join(wanted)}, and none is here. Install "
            "one, or uv, which brings it: pip install uv"
        )
    elif find_spec("virtualenv"):
        _call([sys.executable, "-m", "virtualenv", "--quiet", "--python", python, folder])
    else:
        _call([python, "-m", "venv", folder])


def _put_into(folder: Path, uv: str | None, packages: Sequence[str]) -> None:
    if not packages:
        return
    python = python_in(folder)
    if uv:
        _call([uv, "pip", "install", "--quiet", "--python", python, *packages])
    else:
        _call([python, "-m", "pip", "install", "--quiet", *packages])


def _call(command: Sequence[str | Path]) -> None:
    own = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV")
    environment = {name: value for name, value in os.environ.items() if name not in own}
    try:
        done = subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=_LONGEST_S
        )
    except subprocess.TimeoutExpired:
        raise ConfigurationError(f"{command[0]} did not end in {_LONGEST_S:g} s.") from None
    if done.returncode:
        said = [line.strip() for line in (done.stderr or done.stdout).splitlines() if line.strip()]
        words = _VERSIONS.sub("", " ".join(said[-3:])) or f"exit status {done.returncode}"
        raise ConfigurationError(f"The engine cannot be made: {Path(command[0]).name}: {words}")


def _pythons(version: str) -> list[str]:
    """The versions of Python that run a release, the one that runs this first."""
    release = release_of(version)
    fit = ["3.12", "3.13"] if release >= (10, 0) else ["3.11", "3.12", "3.10", "3.13"]
    if release < (8, 8):
        fit = ["3.10", "3.11"]
    own = "{}.{}".format(*sys.version_info)
    return sorted(fit, key=lambda python: python != own)


def _interpreter(version: str) -> str | None:
    """One of this version on this machine."""
    if version == "{}.{}".format(*sys.version_info):
        return sys.executable
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    named = shutil.which(f"python{version}")
    for found in [*([named] if named else []), *map(str, pyenv.glob(f"{version}.*/bin/python"))]:
        asked = [found, "-c", "import sys; print('%d.%d' % sys.version_info[:2])"]
        done = subprocess.run(asked, capture_output=True, text=True)
        if done.stdout.strip() == version:  # a shim may stand for one that is not selected
            return found
    return None
