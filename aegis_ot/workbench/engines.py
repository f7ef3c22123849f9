"""Which ``opentrons`` rehearses a protocol: the one here where it fits, else an engine of its own.

No release serves both robots at every apiLevel. An engine is an environment that holds one release,
pandas as robots do, and nothing of this package, which is lent to it for a rehearsal.
"""

from __future__ import annotations

import ast
import functools
import os
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError

OT2, FLEX = "OT-2", "Flex"

RELEASES = {"8.8.2": (2, 27), "9.0.0": (2, 28), "10.1.0": (2, 31)}
"""What is installed where a protocol needs it, the oldest that serves it first; with the newest
apiLevel that it knows. Each was tried with both robots."""

_FOR_OT2 = ((8, 0), (9, 1))
"""Releases from here up to there, that one left out, take protocols for an OT-2."""
_FOR_FLEX = (8, 3)
"""Releases from here on simulate a Flex on a workstation."""

_NEWEST = re.compile(r"^MAX_SUPPORTED_VERSION\s*=\s*APIVersion\((\d+),\s*(\d+)\)", re.M)
_LEVEL = re.compile(r"(\d+)\.(\d+)")

Level = tuple[int, int]


@dataclass(frozen=True)
class Need:
    """What a protocol declares: its robot, ``"OT-2"`` or ``"Flex"``, its apiLevel, and where."""

    robot: str
    level: Level
    line: int | None = field(default=None, compare=False)

    def __str__(self) -> str:
        return f"{self.robot}, apiLevel {self.level[0]}.{self.level[1]}"


@dataclass(frozen=True)
class Engine:
    """An ``opentrons`` to rehearse with.

    Attributes:
        version: ``"8.8.2"``.
        newest: The last apiLevel that it knows.
        python: Its interpreter; ``""`` for the environment that this runs in.
        folder: Of the engine; ``None`` likewise.
    """

    version: str
    newest: Level
    python: str = ""
    folder: Path | None = None

    @property
    def robots(self) -> tuple[str, ...]:
        """The robots whose protocols it takes."""
        release = release_of(self.version)
        ot2 = (OT2,) if _FOR_OT2[0] <= release < _FOR_OT2[1] else ()
        return (*ot2, FLEX) if release >= _FOR_FLEX else ot2

    def serves(self, need: Need) -> bool:
        """Whether it takes such a protocol."""
        return need.robot in self.robots and need.level <= self.newest

    def __str__(self) -> str:
        level = f"up to {self.newest[0]}.{self.newest[1]}"
        return f"opentrons {self.version} ({' and '.join(self.robots)}, {level})"


class EngineMissing(ConfigurationError):
    """No ``opentrons`` here serves a protocol.

    Attributes:
        version: The release that would, ``""`` if none is known.
        line: Of the protocol, where it says what it needs.
    """

    def __init__(self, message: str, version: str = "", line: int | None = None) -> None:
        super().__init__(message)
        self.version, self.line = version, line


def release_of(version: str) -> tuple[int, int]:
    """``(8, 8)`` of ``"8.8.2"``."""
    found = _LEVEL.match(version)
    return (int(found[1]), int(found[2])) if found else (0, 0)


def need_of(text: str) -> Need | None:
    """What a Python protocol declares, as Opentrons reads it; ``None`` where it cannot be told."""
    try:
        body = ast.parse(text).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    said: dict[str, Any] = {}
    lines: dict[str, int] = {}
    for node in body:
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Dict):
            names = [target.id for target in node.targets if isinstance(target, ast.Name)]
            for key, value in zip(node.value.keys, node.value.values, strict=True):
                if isinstance(key, ast.Constant) and isinstance(value, ast.Constant):
                    said |= {f"{name}.{key.value!s}": value.value for name in names}
                    lines |= {f"{name}.{key.value!s}": key.lineno for name in names}
    place = "requirements.apiLevel" if "requirements.apiLevel" in said else "metadata.apiLevel"
    level = str(said.get(place))
    found = _LEVEL.fullmatch(level)
    if found is None:
        return None
    robot = str(said.get("requirements.robotType", OT2))
    robot = FLEX if robot in (FLEX, "OT-3") else OT2
    return Need(robot, (int(found[1]), int(found[2])), lines[place])


def engine_for(need: Need | None, robot_version: str = "") -> Engine:
    """The engine that rehearses such a protocol.

    Args:
        need: ``None`` where it is not known: then any will say what is wrong with the protocol.
        robot_version: Of the robot that it is for, which goes first.

    Raises:
        EngineMissing: There is none here; told with what to type.
    """
    own = here()
    engines = [*([own] if own else []), *installed()]
    exact = [e for e in engines if robot_version and e.version == robot_version]
    for engine in [*exact, *engines]:
        if need is None or engine.serves(need):
            return engine
    for version, newest in RELEASES.items():
        if need is None or Engine(version, newest).serves(need):
            has = f"the one here is {own.version}" if own else "none is here"
            what = f"rehearsing it ({need})" if need else "rehearsing"
            raise EngineMissing(
                f"{what} needs opentrons {version}, and {has}; "
                f"type: aegis-ot engines install {version}",
                version,
                need.line if need else None,
            )
    assert need is not None
    known = [Engine(*release) for release in RELEASES.items()]
    newest = max(engine.newest for engine in known if need.robot in engine.robots)
    raise EngineMissing(
        f"it is written for {need}, which no engine that this aegis-ot knows takes: "
        f"{need.robot} ends at {newest[0]}.{newest[1]}. Lower the apiLevel, or renew aegis-ot.",
        line=need.line,
    )


@functools.cache
def here() -> Engine | None:
    """The ``opentrons`` of the environment that this runs in, if there is one."""
    spec = find_spec("opentrons")
    if spec is None or spec.origin is None:
        return None
    return _engine_at(Path(spec.origin).parent)


def installed() -> list[Engine]:
    """The engines that were made, the oldest release first."""
    found = []
    for folder in engines_folder().glob("[0-9]*"):
        sites = (*folder.glob("lib/python*/site-packages"), folder / "Lib" / "site-packages")
        for site in sites:
            engine = _engine_at(site / "opentrons", folder)
            if engine is not None:
                found.append(engine)
    return sorted(found, key=lambda engine: (release_of(engine.version), engine.version))


def engines_folder() -> Path:
    """Where engines are kept: ``AEGIS_OT_ENGINES``, else the user's data folder."""
    given = os.environ.get("AEGIS_OT_ENGINES")
    if given:
        return Path(given)
    from platformdirs import user_data_path

    return user_data_path("aegis-ot", appauthor=False) / "engines"


def python_in(folder: Path) -> Path:
    """The interpreter of an environment."""
    return folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")


def _engine_at(package: Path, folder: Path | None = None) -> Engine | None:
    """The engine whose ``opentrons`` lies in this folder; its text is read, nothing is loaded."""
    try:
        file = package / "protocols" / "api_support" / "definitions.py"
        found = _NEWEST.search(file.read_text(encoding="utf-8"))
    except OSError:
        return None
    versions = list(_versions_beside(package))
    if found is None or not versions:
        return None
    newest = int(found[1]), int(found[2])
    return Engine(versions[0], newest, str(python_in(folder)) if folder else "", folder)


def _versions_beside(package: Path) -> Iterator[str]:
    for path in package.parent.glob("opentrons-*.dist-info"):
        yield path.name.removesuffix(".dist-info").split("-")[1]
