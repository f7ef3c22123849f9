"""``aegis-ot simulate``: a dry run of any protocol file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from ..settings import load_settings
from ..workbench.given import seconds_of
from .options import Timeout, one_of

app = typer.Typer()


@app.command()
def simulate(
    protocol: Annotated[Path, typer.Argument(help="A Python protocol, guarded or not.")],
    fault: Annotated[
        list[str] | None,
        typer.Option(
            help="Plant a fault: partial:50@B3, no_aspirate@C4, no_dispense@#12, air_bubble@D1, "
            "no_tip@E1. May be given more than once."
        ),
    ] = None,
    recover: Annotated[
        list[str] | None,
        typer.Option(
            help="Let the robot put failed wells right: no_aspirate=retry, no_dispense=retry, "
            "partial_dispense=top_up. May be given more than once."
        ),
    ] = None,
    on_fail: Annotated[
        str, typer.Option(help="continue: report a pause and go on; stop: end the run there.")
    ] = "continue",
    rules: Annotated[str, typer.Option(help="Layer 1: on, warn or off.")] = "on",
    first_wells: Annotated[
        str,
        typer.Option(
            help="Where no liquid is seen to leave the tip: ask (nobody is there: undecided), or "
            "trust: you say that the first wells are right."
        ),
    ] = "ask",
    seed: Annotated[int, typer.Option(min=0, help="Seed of the simulated camera.")] = 0,
    labware: Annotated[
        list[Path] | None, typer.Option(help="Folder or file with custom labware definitions.")
    ] = None,
    parameter: Annotated[
        list[str] | None, typer.Option(help="Runtime parameter as NAME=VALUE.")
    ] = None,
    timeout: Timeout = None,
    live: Annotated[
        bool,
        typer.Option(
            "--open",
            help="Open the live page, at a robot's pace. After a failure it waits for your answer "
            "there.",
        ),
    ] = False,
    report: Annotated[Path | None, typer.Option(help="Write an HTML report here.")] = None,
    data: Annotated[
        Path | None,
        typer.Option(help="Keep the run in this data folder: aegis-ot sidecar --data shows it."),
    ] = None,
) -> None:
    """Run a protocol with both layers on this machine: no robot, no camera, no key."""
    from ..dryrun import TRUSTING, DryRunSettings, read_script
    from ..sidecar.config import CascadeSettings
    from .dryrun_screen import exit_code, run_and_show, write_report

    asks = one_of("--first-wells", first_wells, ("ask", "trust")) == "ask"
    settings = DryRunSettings(
        faults=tuple(fault or ()),
        recover=load_settings(recover=_pairs(recover or ())).recover,
        on_fail=one_of("--on-fail", on_fail, ("continue", "stop")),
        seed=seed,
        rules=one_of("--rules", rules, ("on", "warn", "off")),
        timeout_s=seconds_of(timeout),
        data=data,
        live=live,
        cascade=CascadeSettings() if asks else TRUSTING,
    )
    script = read_script(protocol, labware or (), parameter or ())
    result = run_and_show(script, settings)
    if report is not None:
        write_report(report, [result])
    raise typer.Exit(exit_code(result))


def _pairs(given: Sequence[str]) -> dict[str, str]:
    """``["no_aspirate=retry"]`` as a setting."""
    parts = (one.partition("=") for one in given)
    return {kind.strip(): action.strip() for kind, _, action in parts}
