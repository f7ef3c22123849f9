"""Puts the commands together and turns errors into messages and exit codes."""

from __future__ import annotations

import logging
import sys
import warnings
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from .. import __version__
from ..errors import AegisError, ConfigurationError
from .commands import COMMANDS, load_command, what_to_install
from .exit_codes import BROKEN, INTERRUPTED
from .plain_text import echo


class _Commands(TyperGroup):
    """Shows each command by its summary, and loads the one that is called."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        for name, command in COMMANDS.items():
            self.add_command(TyperCommand(name, help=command.summary))

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """As plain text: loading what draws boxes takes twice as long as all the rest."""
        groups: dict[str, list[tuple[str, str]]] = {}
        for name, command in COMMANDS.items():
            groups.setdefault(command.group, []).append((f"{name:<11}", command.summary))
        for heading, lines in groups.items():
            with formatter.section(heading):
                formatter.write_dl(lines)

    def resolve_command(self, ctx: Any, args: Any) -> Any:
        name, command, rest = super().resolve_command(ctx, args)
        return name, command and load_command(str(name)), rest

    def invoke(self, ctx: Any) -> Any:
        called = (*ctx._protected_args, *ctx.args)
        try:
            return super().invoke(ctx)
        except ModuleNotFoundError as error:
            library = (error.name or "").partition(".")[0]
            if library in ("", "aegis_ot") or called[0] not in COMMANDS:
                raise
            raise ConfigurationError(what_to_install(called[0], error)) from error


app = typer.Typer(
    name="aegis-ot",
    cls=_Commands,
    help="Guards Opentrons robots: checks protocols before they run, watches tips while they do.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(asked: bool) -> None:
    if asked:
        typer.echo(f"aegis-ot {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    _version_asked: bool = typer.Option(
        False, "--version", callback=_version, is_eager=True, help="Print the version."
    ),
) -> None:
    """Options before the command."""


# Typer has taken over Click's errors in its newer versions; both know this one by name.
_UsageError: Any = next(k for k in typer.BadParameter.__mro__ if k.__name__ == "ClickException")


def _quiet_libraries() -> None:
    """What a library has to say of another library's code is nothing to a user."""
    if not sys.warnoptions:  # a developer has asked for warnings
        warnings.filterwarnings("ignore", r"The '\w+' attribute with value .* `Field\(\)` function")


def run() -> None:
    """Run the app; an error raised on purpose becomes one message and exit code 2."""
    _quiet_libraries()
    # A workstation has no robot's calibration files; Opentrons warns of that at every context.
    logging.getLogger("opentrons").setLevel(logging.ERROR)
    try:
        code = app(standalone_mode=False)
    except _UsageError as error:
        if type(error).__name__ == "NoArgsIsHelpError":
            error.show()
        else:
            echo(f"aegis-ot: {error.format_message()}", err=True)
        code = BROKEN
    except AegisError as error:
        echo(f"aegis-ot: {error}", err=True)
        code = BROKEN
    except (typer.Abort, KeyboardInterrupt):
        code = INTERRUPTED
    if code == INTERRUPTED:  # Typer's newer versions return it, the older ones raise Abort
        typer.echo("aegis-ot: interrupted; nothing more is done.", err=True)
    sys.exit(code)
