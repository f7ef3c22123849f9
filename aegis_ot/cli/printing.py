"""Prints texts that hold names from protocols, robots and stores: none may command the terminal."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import typer
from rich.console import Console
from rich.segment import Segment

from ..vocabulary import no_commands, printable


def plain(text: str) -> str:
    """``text`` of several lines, without escape sequences and without commands to a CI's runner."""
    return no_commands(printable(text, "\n\t"))


def echo(text: str, err: bool = False, nl: bool = True) -> None:
    """Print a text that is not styled."""
    typer.echo(plain(text), err=err, nl=nl)


class PlainConsole(Console):
    """A console whose own escape sequences are the only ones that it prints."""

    def render(self, *args: Any, **kwargs: Any) -> Iterator[Segment]:
        """As Rich does."""
        for part in super().render(*args, **kwargs):
            yield part if part.control else Segment(plain(part.text), part.style)
