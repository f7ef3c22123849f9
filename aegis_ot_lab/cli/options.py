"""What several commands of the laboratory take, beside what they share with the others."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from aegis_ot.errors import ConfigurationError

Files = Annotated[list[Path], typer.Argument(help="Python protocols.")]
ModelNames = Annotated[
    list[str] | None,
    typer.Option(
        "--model", help="Model to ask, see `check --model`; repeatable, to compare models."
    ),
]


def writable_folder(folder: Path) -> None:
    """Make a folder: fail before the work and not after it.

    Raises:
        ConfigurationError: It cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ConfigurationError(f"{folder} cannot be made: {error.strerror}.") from None
