"""``aegis-ot evaluate``: a layer scored on labelled data."""

from __future__ import annotations

import typer

from .layer1 import layer1
from .layer2 import layer2

app = typer.Typer()
evaluate = typer.Typer(no_args_is_help=True, help="Score a layer on labelled data.")
app.add_typer(evaluate, name="evaluate")
evaluate.command()(layer1)
evaluate.command()(layer2)
