"""Puts the commands together and turns errors into messages and exit codes."""

from __future__ import annotations

import logging
import sys
from typing import Any

import typer

from .. import __version__
from ..errors import AegisError

CLEAN, FINDINGS, BROKEN, INTERRUPTED = 0, 1, 2, 130

app = typer.Typer(
    name="aegis-ot",
    help="Guards Opentrons robots: checks protocols before they run, watches tips while they do.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
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


def run() -> None:
    """Run the app; an error raised on purpose becomes one message and exit code 2."""
    # A workstation has no robot's calibration files; Opentrons warns of that at every context.
    logging.getLogger("opentrons").setLevel(logging.ERROR)
    try:
        code = app(standalone_mode=False)
    except _UsageError as error:
        if type(error).__name__ == "NoArgsIsHelpError":
            error.show()
        else:
            typer.echo(f"aegis-ot: {error.format_message()}", err=True)
        code = BROKEN
    except AegisError as error:
        typer.echo(f"aegis-ot: {error}", err=True)
        code = BROKEN
    except (typer.Abort, KeyboardInterrupt):
        code = INTERRUPTED
    if code == INTERRUPTED:  # Typer's newer versions return it, the older ones raise Abort
        typer.echo("aegis-ot: interrupted; nothing more is done.", err=True)
    sys.exit(code)


# Each module adds its commands to the app.
from . import (  # noqa: E402
    audits,  # noqa: F401
    checks,  # noqa: F401
    corpora,  # noqa: F401
    datasets,  # noqa: F401
    demo,  # noqa: F401
    dryruns,  # noqa: F401
    evaluations,  # noqa: F401
    fleets,  # noqa: F401
    inspections,  # noqa: F401
    layer2,  # noqa: F401
    llm,  # noqa: F401
    onto_robot,  # noqa: F401
    reproductions,  # noqa: F401
    robots,  # noqa: F401
    rulebook,  # noqa: F401
    runs,  # noqa: F401
    services,  # noqa: F401
    sidecars,  # noqa: F401
    trainings,  # noqa: F401
    worldmodels,  # noqa: F401
)
