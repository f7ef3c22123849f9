"""What lies around a protocol: its own folder, and the modules of its repository that it imports.

Opentrons loads a protocol alone. A rehearsal runs in the protocol's folder, and finds what is not
installed where the protocol's author has it: beside the protocol, or above it up to the root of the
checkout. That holds for the rehearsal only, and is told.
"""

from __future__ import annotations

import ast
import builtins
import contextlib
import os
import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType
from typing import Any

from ..adapters.opentrons.rehearsal import Script
from ..vocabulary import Remark

_LARGEST_MODULE_BYTES = 1_000_000
_LARGEST_DATA_BYTES = 20_000_000
_FILE_NAMES = re.compile(r"""["']([^"'\n\\]{1,200}\.\w{1,6})["']""")
_DATA_NAMES = re.compile(r"""["']([^"'\n]{1,200}\.(?:json|csv|tsv|txt|xlsx?|ya?ml))["']""", re.I)
_MOST_FOLDERS = 5000
NO_SOURCES = frozenset({"__pycache__", "node_modules", "site-packages", "venv", "build", "dist"})
"""Folders, beside hidden ones, that hold no protocols and no labware of a laboratory."""


@dataclass(frozen=True)
class Neighbour:
    """A module that a protocol, or another module of its, imports and that lies around it; or a
    file that it reads from a place which is not there, and that lies in its repository.

    Attributes:
        folder: Where it lies.
        path: Of its file or package, as seen from the protocol's folder.
        line: Where the protocol names it; ``None`` where another module does.
        is_data: Whether it is such a file.
    """

    folder: str
    path: str
    line: int | None
    is_data: bool = False

    def told(self, name: str) -> Remark:
        """That it was found there."""
        if self.is_data:
            return Remark(
                f"It reads {name} from a place that is not there; the one at {self.path} was read "
                "for this rehearsal only: name it by a path that the robot has.",
                self.line,
            )
        return Remark(
            f"It imports {name}, which was found at {self.path} for this rehearsal only: Opentrons "
            f"loads a protocol alone, so {name} has to be installed on the robot as well.",
            self.line,
        )


@dataclass(frozen=True)
class Placed(Script):
    """A protocol with the place where it lies.

    Attributes:
        folder: Its folder; ``""`` for none.
        modules: What it imports or reads from around it, by name.
    """

    folder: str = ""
    modules: Mapping[str, Neighbour] = field(default_factory=dict)


def root_of(path: Path, bounds: Sequence[Path]) -> Path:
    """The root of the checkout that a file lies in; without one the first of ``bounds`` that holds
    the file, else its own folder. A home folder bounds nothing."""
    path = path.resolve()
    for folder in path.parents:
        if (folder / ".git").exists():
            return folder
    for bound in map(Path.resolve, bounds):
        if bound in path.parents and bound not in (Path(bound.anchor), Path.home()):
            return bound
    return path.parent


@dataclass(frozen=True)
class Surroundings:
    """What a protocol imports from around it.

    Attributes:
        modules: By name.
        texts: Of the source files behind them, by path.
    """

    modules: Mapping[str, Neighbour]
    texts: Mapping[Path, str]


def surroundings_of(path: Path, text: str, root: Path) -> Surroundings:
    """Look for what a protocol's text imports, and for what that imports."""
    own = path.resolve().parent
    folders = [own]
    while folders[-1] != root and root in folders[-1].parents:
        folders.append(folders[-1].parent)
    modules: dict[str, Neighbour] = {}
    texts: dict[Path, str] = {}
    open_: list[tuple[str, Path | None]] = [(text, None)]
    while open_:
        source, file = open_.pop()
        for parts, level, line in _imports(source):
            if level:
                places = [file.parents[level - 1]] if file and level <= len(file.parents) else []
            elif parts[0] in sys.stdlib_module_names or parts[0] == "opentrons":
                continue
            else:
                places = [f for f in folders if _module(f / parts[0])][:1]
                for place in places:
                    shown = os.path.relpath(_module(place / parts[0]) or place, own)
                    there = line if file is None else None
                    modules.setdefault(
                        parts[0], Neighbour(str(place), Path(shown).as_posix(), there)
                    )
            for place in places:
                for found in _files(place, parts):
                    if found not in texts and found != path.resolve():
                        texts[found] = _text(found)
                        open_.append((texts[found], found))
    return Surroundings({**modules, **dict(_data_elsewhere(own, text, root))}, texts)


def _data_elsewhere(own: Path, text: str, root: Path) -> Iterator[tuple[str, Neighbour]]:
    """Files that a protocol's text names, which are not where it says, and lie in its repository
    once: by an author's own path, or one from the root.
    """
    wanted: dict[str, int] = {}
    for found in _DATA_NAMES.finditer(text):
        with contextlib.suppress(OSError, ValueError):
            if not (own / found[1]).exists():
                name = re.split(r"[/\\]", found[1])[-1]
                wanted.setdefault(name, text.count("\n", 0, found.start()) + 1)
    if not wanted or not (root / ".git").exists():
        return
    places: dict[str, list[Path]] = {}
    for number, (folder, below, files) in enumerate(os.walk(root)):
        below[:] = [name for name in below if name[0] != "." and name not in NO_SOURCES]
        for name in wanted.keys() & set(files):
            places.setdefault(name, []).append(Path(folder))
        if number > _MOST_FOLDERS:
            return
    for name, folders in places.items():
        if len({(folder / name).read_bytes() for folder in folders}) == 1:
            shown = Path(os.path.relpath(folders[0] / name, own)).as_posix()
            yield name, Neighbour(str(folders[0]), shown, wanted[name], is_data=True)


def data_named(path: Path, text: str) -> Iterator[Path]:
    """Files beside a protocol, or below, that its text names."""
    for name in sorted(set(_FILE_NAMES.findall(text))):
        with contextlib.suppress(OSError, ValueError):
            file = path.parent / name
            if file.is_file() and file.stat().st_size <= _LARGEST_DATA_BYTES:
                yield file


def _imports(text: str) -> Iterator[tuple[tuple[str, ...], int, int]]:
    """Names of modules that may be imported, each with its level and line."""
    try:
        nodes = list(ast.walk(ast.parse(text)))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return
    for node in nodes:
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield tuple(alias.name.split(".")), 0, node.lineno
        elif isinstance(node, ast.ImportFrom):
            module = tuple((node.module or "").split(".")) if node.module else ()
            for alias in node.names:
                yield (*module, alias.name), node.level, node.lineno


def _module(place: Path) -> Path | None:
    """The file or the folder of a module of this path without its ending."""
    file = place.with_name(f"{place.name}.py")
    if file.is_file():
        return file
    sources = (place.glob("*.py"), place.glob("*/*.py")) if place.is_dir() else ()
    return place if any(map(any, sources)) else None


def _files(place: Path, parts: Sequence[str]) -> Iterator[Path]:
    """The source files that an import of ``parts`` from ``place`` reads."""
    for part in parts:
        place = place / part
        for file in (place.with_name(f"{part}.py"), place / "__init__.py"):
            if file.is_file():
                yield file.resolve()


def _text(file: Path) -> str:
    with contextlib.suppress(OSError, UnicodeDecodeError):
        if file.stat().st_size <= _LARGEST_MODULE_BYTES:
            return file.read_text(encoding="utf-8-sig")
    return ""


@contextlib.contextmanager
def standing_in_place(script: Script) -> Iterator[list[str]]:
    """Work where a protocol lies, with the modules around it. What is installed goes first.

    Yields:
        The names of those that were imported from around it so far.
    """
    if not isinstance(script, Placed) or not script.folder:
        yield []
        return
    finder = _Finder(script.modules)
    before, known, opens = os.getcwd(), set(sys.modules), open
    os.chdir(script.folder)
    sys.meta_path.append(finder)
    builtins.open = finder.opening(opens)
    try:
        yield finder.found
    finally:
        builtins.open = opens
        sys.meta_path.remove(finder)
        for name in set(sys.modules) - known:
            if name.partition(".")[0] in finder.found:
                del sys.modules[name]
        os.chdir(before)


class _Finder:
    """Finds modules around a protocol that no other finder has found, and files that it reads."""

    def __init__(self, modules: Mapping[str, Neighbour]) -> None:
        self._modules = modules
        self.found: list[str] = []

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """As the import system asks."""
        if path is not None or name not in self._modules or self._modules[name].is_data:
            return None
        spec = PathFinder.find_spec(name, [self._modules[name].folder])
        if spec is not None and name not in self.found:
            self.found.append(name)
        return spec

    def opening(self, opens: Callable[..., Any]) -> Callable[..., Any]:
        """An ``open`` that reads a file which is not where it is looked for from where it lies."""

        def opened(file: Any, *args: Any, **kwargs: Any) -> Any:
            try:
                return opens(file, *args, **kwargs)
            except FileNotFoundError:
                name = re.split(r"[/\\]", str(file))[-1]
                there = self._modules.get(name)
                if there is None or not there.is_data:
                    raise
                if name not in self.found:
                    self.found.append(name)
                return opens(os.path.join(there.folder, name), *args, **kwargs)

        return opened
