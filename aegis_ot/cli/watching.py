"""``aegis-ot check --watch``: the same check again whenever something around a protocol changes."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path

import typer

from ..errors import AegisError
from ..workbench.files_read import signatures
from ..workbench.surroundings import NO_SOURCES
from .plain_text import echo

_LOOK_S = 0.3
_MOST_LEVELS = 2
_ENDINGS = frozenset({".py", ".json", ".csv", ".tsv", ".txt", ".toml", ".xlsx"})


def watch(places: Iterable[Path], check: Callable[[], None]) -> None:
    """Check now and after each change, until Ctrl-C.

    Args:
        places: Protocols and folders; what lies beside and below them is looked at too.
        check: Does it, and shows what came of it.
    """
    folders = {place if place.is_dir() else place.parent for place in places}
    while True:
        seen = _seen(folders)
        if sys.stdout.isatty():
            sys.stdout.write("\x1b[2J\x1b[H")
        try:
            check()
        except typer.Exit:
            pass
        except AegisError as error:
            echo(f"aegis-ot: {error}", err=True)
        echo("Watching for changes; Ctrl-C ends.", err=True)
        while _seen(folders) == seen:
            time.sleep(_LOOK_S)


def _seen(folders: Iterable[Path]) -> dict[str, object]:
    """What lies in these folders and a little below, and the projects above, as it stands."""
    found: list[str] = []
    for folder in folders:
        found += [str(above / "pyproject.toml") for above in (folder, *folder.resolve().parents)]
        found += [str(path) for path in _files(folder, _MOST_LEVELS)]
    return dict(signatures(found))


def _files(folder: Path, levels: int) -> Iterable[Path]:
    try:
        inside = sorted(folder.iterdir())
    except OSError:
        return
    for path in inside:
        if path.suffix in _ENDINGS:
            yield path
        elif levels and not path.name.startswith(".") and path.name not in NO_SOURCES:
            yield from _files(path, levels - 1) if path.is_dir() else ()
