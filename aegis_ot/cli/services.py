"""``aegis-ot doctor``: is everything in place?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from .exit_codes import BROKEN, CLEAN, FINDINGS
from .printing import PlainConsole

_COLOURS = {"ok": "green", "warning": "yellow", "bad": "bold red"}


app = typer.Typer()


@app.command()
def doctor(
    camera: Annotated[
        str | None, typer.Option(help="As for aegis-ot sidecar; its settings' if left out.")
    ] = None,
    robot: Annotated[str | None, typer.Option(help="Address of a robot to look for.")] = None,
    host: Annotated[str | None, typer.Option(help="As for aegis-ot sidecar.")] = None,
    port: Annotated[int | None, typer.Option(help="As for aegis-ot sidecar.")] = None,
    data: Annotated[Path | None, typer.Option(help="As for aegis-ot sidecar.")] = None,
    config: Annotated[Path | None, typer.Option(help="Settings file, JSON or TOML.")] = None,
) -> None:
    """Look at camera, light, detector, disk, store, token, models, clock and robot.

    Nothing is changed. Exit codes: 0 all is well, 1 a run is possible but something should be
    better, 2 something must be mended first.
    """
    from ..doctor import examine
    from ..sidecar import SidecarConfig
    from ..sidecar.token_file import known_token

    settings = SidecarConfig.load(
        config,
        find_token=known_token,
        host=host,
        port=port,
        data=data,
        camera=None if camera is None else {"spec": camera},
    )
    console = PlainConsole(highlight=False)
    worst = CLEAN
    for check in examine(settings, robot):
        line = Text(f"{check.state:8}", style=_COLOURS[check.state])
        console.print(line + Text(f"{check.name}: {check.said}", style="default"), soft_wrap=True)
        if check.todo:
            console.print(Text(f"        {check.todo}"), soft_wrap=True)
        worst = max(worst, {"ok": CLEAN, "warning": FINDINGS, "bad": BROKEN}[check.state])
    raise typer.Exit(worst)
