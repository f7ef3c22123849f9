"""Options that name a model, for every command that can ask one."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import ConfigurationError
from ..vocabulary.opinions import MODEL_FORMS

if TYPE_CHECKING:
    from ..llm import Backend

ModelName = Annotated[
    str | None,
    typer.Option("--model", help=f"{MODEL_FORMS}, or none (AEGIS_OT_MODEL if left out)."),
]
RecordFolder = Annotated[
    Path | None,
    typer.Option("--record", help="Keep requests and answers in this folder, for replay:FOLDER."),
]


def backend_of(
    model: str | None,
    record: Path | None,
    configured: str | None = None,
    folder: Path | None = None,
) -> Backend | None:
    """The model that the command line names, else the environment, else the project.

    Args:
        model: Of the command line; ``none``: no model, whoever else names one.
        record: Folder for requests and answers.
        configured: Of the project.
        folder: The project's.

    Raises:
        ConfigurationError: Its name makes no sense, or there is nothing to record.
    """
    if not (model or record or configured or os.environ.get("AEGIS_OT_MODEL")):
        return None
    from ..llm import make_backend, model_from_environment, project_model, record_from_environment

    name = model or model_from_environment()
    if name is None and configured is not None:
        name = project_model(configured, folder or Path())
    if name is not None and name.strip() not in ("", "none"):
        return make_backend(name, record or record_from_environment())
    if record is not None:
        raise ConfigurationError("--record: no model is asked. Name one with --model.")
    return None
