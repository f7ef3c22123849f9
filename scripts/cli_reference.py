"""Writes ``docs/reference/cli.md`` from the commands: ``python -m scripts.cli_reference``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer

from aegis_ot.cli.app import app
from aegis_ot.cli.commands import load_command

PAGE = Path(__file__).parents[1] / "docs" / "reference" / "cli.md"


def commands(group: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Each command with the words that call it, those of groups included."""
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from commands(command, (*path, name))
        else:
            yield (*path, name), command


def root() -> Any:
    """The whole command line with every command loaded, as Click sees it."""
    group: Any = typer.main.get_command(app)
    group.commands = {name: load_command(name) for name in group.commands}
    return group


def page() -> str:
    """The whole page, Markdown."""
    parts = [
        "<!-- Written by `make docs` from the commands. Edit those. -->",
        "# Command line",
        "`aegis-ot COMMAND --help` says the same. An option that may be given more than once is\n"
        "said to be *repeatable*.",
        *(_section(path, command) for path, command in commands(root())),
    ]
    return "\n\n".join(parts) + "\n"


def _section(path: tuple[str, ...], command: Any) -> str:
    arguments = [p for p in command.params if p.param_type_name == "argument"]
    options = [p for p in command.params if p.param_type_name == "option"]
    usage = " ".join(["aegis-ot", *path, *map(_placeholder, arguments), "[OPTIONS]"])
    paragraphs = [" ".join(part.split()) for part in (command.help or "").split("\n\n")]
    lines = [f"## {' '.join(path)}", f"```text\n{usage}\n```", *paragraphs]
    rows = [_row(f"`{_placeholder(p)}`", p) for p in arguments]
    rows += [_row(_names(p), p) for p in options]
    if rows:
        lines.append("\n".join(["| | default | |", "|---|---|---|", *rows]))
    return "\n\n".join(lines)


def _placeholder(argument: Any) -> str:
    name = argument.name.upper() + ("..." if argument.nargs == -1 else "")
    return name if argument.required else f"[{name}]"


def _names(option: Any) -> str:
    return ", ".join(f"`{name}`" for name in (*option.opts, *option.secondary_opts))


def _row(name: str, parameter: Any) -> str:
    text = " ".join((parameter.help or "").split()).replace("|", "\\|")
    told = any(word in text for word in ("epeatable", "May be given"))
    if getattr(parameter, "multiple", False) and not told:
        text += " Repeatable."
    return f"| {name} | {_default(parameter)} | {text} |"


def _default(parameter: Any) -> str:
    if parameter.required:
        return "required"
    value = parameter.default
    if value is True:
        return "on"
    return f"`{value}`" if value and isinstance(value, str | int | float | Path) else ""


def main() -> int:
    PAGE.write_text(page(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
