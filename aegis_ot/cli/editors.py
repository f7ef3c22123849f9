"""``aegis-ot lsp`` and ``aegis-ot mcp``: Layer 1 for an editor, and for an agent, over stdio."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer()


@app.command()
def lsp() -> None:
    """Serve an editor: findings as you type, and quick fixes (Language Server Protocol, stdio).

    A text is rehearsed when nobody has typed for half a second. Only what is a protocol is judged.
    """
    from ..editor.language_server import make_server

    make_server().start_io()


@app.command()
def mcp(
    data: Annotated[
        Path | None, typer.Option(help="Data folder of the sidecar whose runs are shown.")
    ] = None,
    may_start_on: Annotated[
        list[str] | None,
        typer.Option(
            "--may-start-on",
            help="Address of a robot on which the agent may start what passed Layer 1. May be "
            "given more than once; left out: it starts nothing.",
        ),
    ] = None,
) -> None:
    """Serve an agent: check, explain, simulate, runs (Model Context Protocol, stdio).

    The agent can never answer a pause or release a hold. It starts a run only on a robot that you
    name here, and only if Layer 1 passes the protocol without a finding.
    """
    from ..editor.stdio import ToolServer, private_streams
    from ..editor.tools import INSTRUCTIONS, tools

    incoming, outgoing = private_streams()
    ToolServer(tools(data, may_start_on or ()), INSTRUCTIONS).serve(incoming, outgoing)
