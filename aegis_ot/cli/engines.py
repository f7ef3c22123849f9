"""``aegis-ot engines``: the releases of opentrons that protocols are rehearsed with."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from .plain_text import echo

app = typer.Typer()
engines = typer.Typer(
    help="The releases of opentrons that protocols are rehearsed with.", no_args_is_help=True
)
app.add_typer(engines, name="engines")

InstallEngines = Annotated[
    bool, typer.Option("--install-engines", help="Install the engines that these protocols lack.")
]


@engines.command("list")
def list_() -> None:
    """Say which engines are here, which robots and apiLevels they take, and what lacks."""
    from ..workbench.engines import RELEASES, Engine, engines_folder, here, installed

    own, made = here(), installed()
    for engine in [*([own] if own else []), *made]:
        echo(f"{engine}: {engine.folder or 'the environment of this aegis-ot'}")
    known = {engine.version for engine in [*([own] if own else []), *made]}
    for version, newest in RELEASES.items():
        if version not in known:
            echo(f"{Engine(version, newest)}: not here; aegis-ot engines install {version}")
    echo(f"Engines are kept in {engines_folder()}.")


@engines.command()
def install(
    versions: Annotated[
        list[str] | None, typer.Argument(help="Of opentrons; all that lack if left out.")
    ] = None,
    protocols: Annotated[
        list[Path] | None,
        typer.Option("--for", help="Only what these protocols, or folders of them, need."),
    ] = None,
    packages: Annotated[
        list[str] | None,
        typer.Option("--with", help="A package that protocols import, as for pip; repeatable."),
    ] = None,
) -> None:
    """Make engines: each an environment of its own, in the user's data folder."""
    from ..workbench.engine_making import install as make
    from ..workbench.engines import RELEASES, here, installed

    wanted = list(versions or ())
    if protocols:
        install_for_files(protocols)
    elif not wanted:
        own = here()
        there = {engine.version for engine in installed()} | ({own.version} if own else set())
        wanted = [version for version in RELEASES if version not in there]
    for version in wanted:
        echo(f"{make(version, packages or ())}: installed.")


@engines.command()
def remove(
    versions: Annotated[list[str], typer.Argument(help="As `aegis-ot engines list` shows them.")],
) -> None:
    """Remove engines from the user's data folder."""
    from ..workbench.engine_making import remove as take_away

    for version in versions:
        take_away(version)
        echo(f"opentrons {version}: removed.")


def install_for_files(places: Sequence[Path]) -> None:
    """Make the engines that protocols lack, and say so."""
    from ..workbench.documents import need_of_document
    from ..workbench.engine_making import install_for
    from ..workbench.engines import need_of
    from ..workbench.shelf import protocols_named

    files = protocols_named(places)
    needs = {need_of_document(path) or need_of(_text(path)) for path in files}
    for engine in install_for(sorted(filter(None, needs), key=str)):
        echo(f"{engine}: installed.", err=True)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig", errors="replace")
    except OSError:  # told when it is judged
        return ""
