"""``aegis-ot sidecar``: the workstation's half of Layer 2 as a process."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer()


@app.command()
def sidecar(
    camera: Annotated[
        str | None, typer.Option(help="usb:0, http://..., folder:PATH, pattern or simulated.")
    ] = None,
    host: Annotated[str | None, typer.Option(help="Address to listen on.")] = None,
    port: Annotated[int | None, typer.Option(help="Port; 0 takes a free one.")] = None,
    token: Annotated[
        str | None, typer.Option(help="Bearer token; better given as AEGIS_OT_SIDECAR_TOKEN.")
    ] = None,
    data: Annotated[Path | None, typer.Option(help="Folder for runs and frames.")] = None,
    config: Annotated[Path | None, typer.Option(help="Settings file, JSON or TOML.")] = None,
    model: Annotated[
        str | None,
        typer.Option(help="anthropic:MODEL, openai:MODEL@URL or replay:FOLDER, for opinions."),
    ] = None,
    world_model: Annotated[
        Path | None, typer.Option(help="World model of the lab, written by aegis-ot fit.")
    ] = None,
) -> None:
    """Watch the robot's tips: capture, score, judge, and show a page."""
    from ..audit.process import AuditProcess
    from ..sidecar import SidecarConfig, make_analyser, make_detector, serve
    from ..sidecar.journal import event, set_up
    from ..sidecar.reasoning_routes import gates_of
    from ..sidecar.token_file import TOKEN_FILE, kept_token
    from ..vocabulary import without_secrets

    made: list[str] = []
    kept: list[Path] = []

    def find_token(folder: Path) -> str:
        kept.append(folder / TOKEN_FILE)
        new = not kept[0].exists()
        found = kept_token(folder)
        made.extend([found] if new else [])
        return found

    settings = SidecarConfig.load(
        config,
        find_token=find_token,
        host=host,
        port=port,
        token=token,
        data=data,
        camera=None if camera is None else {"spec": camera},
        model=None if model is None else {"name": model},
        cascade=None if world_model is None else {"model": world_model},
    )

    set_up(settings.log)

    def ready(url: str) -> None:
        camera = without_secrets(settings.camera.spec)
        event("ready", address=url, camera=camera, data=str(settings.data))
        typer.echo(f"aegis-ot sidecar: {settings.url or url}")
        typer.echo(f"camera {camera}, data {settings.data}")
        if made:
            # Standard output of a service ends in a log.
            shown = f": {made[0]}" if sys.stdout.isatty() else ""
            typer.echo(
                f"A token was made{shown}\nIt is kept in {kept[0]}. Log in "
                'with it, and give it to the guard (token="...", or AEGIS_OT_TOKEN on the robot).'
            )
        elif settings.token is not None:
            where = f"the token in {kept[0]}" if kept else "the sidecar's token"
            typer.echo(f"Log in with {where}.")

    detector = make_detector(settings.cascade)
    analyser = make_analyser(settings.cascade, gates_of(settings), detector)
    auditor = AuditProcess(settings)
    serve(settings, analyser=analyser, ready=ready, detector=detector, auditor=auditor)
    event("stopped")
