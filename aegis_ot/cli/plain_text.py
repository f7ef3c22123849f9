"""Prints texts that hold names from protocols, robots and stores: none may command the terminal."""

from __future__ import annotations

import typer

from ..vocabulary import no_commands, printable


def plain(text: str) -> str:
    """``text`` of several lines, without escape sequences and without commands to a CI's runner."""
    return no_commands(printable(text, "\n\t"))


def echo(text: str, err: bool = False, nl: bool = True) -> None:
    """Print a text that is not styled."""
    typer.echo(plain(text), err=err, nl=nl)
