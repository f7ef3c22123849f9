"""An environment with what an extra asks for, and nothing besides.

Nothing is downloaded: the distributions that an extra names in ``pyproject.toml``, and all that
they require, are linked from the environment that the tests run in. What is not declared is not
there.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterable, Iterator
from importlib import metadata
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]


def make_environment(folder: Path, extras: Iterable[str]) -> Path:
    """Make a virtual environment with these extras; returns its interpreter."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
    (site,) = folder.glob("lib/python*/site-packages")
    for distribution in _closure(extras):
        base = Path(str(distribution.locate_file("")))
        for name in {Path(file.parts[0]) for file in distribution.files or ()}:
            if ".." not in name.parts and name.suffix != ".pth":
                _link(base / name, site / name)
    (site / "checkout.pth").write_text(f"{ROOT}\n", encoding="utf-8")
    return folder / "bin" / "python"


def _link(source: Path, target: Path) -> None:
    """Link a file or folder; folders of one name (namespace packages) become one."""
    if not source.exists():
        return
    if target.is_symlink() and target.is_dir() and target.resolve() != source.resolve():
        first = target.resolve()
        target.unlink()
        target.mkdir()
        for inner in first.iterdir():
            _link(inner, target / inner.name)
    if not target.exists():
        target.symlink_to(source)
    elif target.is_dir() and not target.is_symlink():
        for inner in source.iterdir():
            _link(inner, target / inner.name)


def _closure(extras: Iterable[str]) -> Iterator[metadata.Distribution]:
    """The distributions of some extras, and what these require, each once."""
    todo = [Requirement(text) for extra in extras for text in _declared(extra)]
    seen: set[tuple[str, str]] = set()
    given: set[str] = set()
    while todo:
        requirement = todo.pop()
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": ""}):
            continue
        distribution = metadata.distribution(requirement.name)
        name = canonicalize_name(requirement.name)
        if name not in given:
            given.add(name)
            yield distribution
        for extra in ("", *requirement.extras):
            if (name, extra) in seen:
                continue
            seen.add((name, extra))
            for text in distribution.requires or ():
                needed = Requirement(text)
                if needed.marker is None or needed.marker.evaluate({"extra": extra}):
                    needed.marker = None
                    todo.append(needed)


def _declared(extra: str) -> list[str]:
    """What an extra asks for, those extras of our own that it names included."""
    import tomllib

    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    found: list[str] = []
    for text in project["optional-dependencies"][extra]:
        requirement = Requirement(text)
        if canonicalize_name(requirement.name) == project["name"]:
            found += [item for inner in requirement.extras for item in _declared(inner)]
        else:
            found.append(text)
    return found
