"""``aegis-ot demo``: what the guard does, on three small stories, in about a minute."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import aegis_ot

from ..vocabulary import counted
from .exit_codes import BROKEN

if TYPE_CHECKING:
    from ..dryrun import DryRun

_REJECTED = "pcr_setup_contaminated.py"
_LONG = "normalisation_plate.py"
_FAULT = "partial:50@3:D4"
"""Half of the dye stays in the tip at D4 of the plate in slot 3; 16 more wells would follow."""
_FAULTS = ("no_dispense@3:H1", _FAULT, "no_aspirate@3:B5")
"""What a person meets on the live page, one after another."""


app = typer.Typer()


@app.command()
def demo(
    out: Annotated[Path, typer.Option(help="Folder for the report.")] = Path("out"),
    live: Annotated[
        bool,
        typer.Option(
            "--open", help="Open the live page of a run with planted faults; you are the operator."
        ),
    ] = False,
) -> None:
    """Show a protocol rejected, a run watched, and a run paused at the failed well."""
    from .dryrun_screen import console, write_report

    if live:
        _run(_LONG, faults=_FAULTS, live=True)
        return
    console.rule("1. Layer 1 rejects a contaminated PCR set-up")
    rejected = _run(_REJECTED)
    console.rule("2. Layer 2 watches a whole normal run (simulated frames)")
    watched = _run(_LONG)
    console.rule(f"3. The same run with a planted fault: {_FAULT} (simulated frames)")
    paused = _run(_LONG, faults=(_FAULT,), on_fail="stop")
    console.rule("What was caught")
    report = out / "demo-report.html"
    write_report(report, [rejected, watched, paused])
    told = [
        (rejected.outcome == "rejected", f"{_REJECTED}: {_what_happened(rejected)}"),
        (
            watched.outcome == "succeeded" and not watched.flagged,
            f"{_LONG}: {_what_happened(watched)}",
        ),
        (
            paused.outcome == "stopped"
            and [row.well.split()[0] for row in paused.flagged] == ["D4"]
            and not paused.touched_after_failure,
            f"{_LONG} with {_FAULT}: {_what_happened(paused)}",
        ),
    ]
    for as_told, line in told:
        console.print(("  caught  " if as_told else "  MISSED  ") + line, markup=False)
    if not all(as_told for as_told, _ in told):
        raise typer.Exit(BROKEN)


def _what_happened(result: DryRun) -> str:
    """In one line, whatever it was."""
    if result.outcome == "rejected":
        return "rejected before anything moved"
    flagged = [row.well.split()[0] for row in result.flagged]
    if result.outcome == "stopped":
        touched = ", ".join(result.touched_after_failure)
        after = f"then touched {touched}" if touched else "no further well touched"
        return f"paused at {', '.join(flagged) or 'no failed well'}, {after}"
    found = f"{', '.join(flagged)} flagged" if flagged else "no false alarm"
    ended = "" if result.outcome == "succeeded" else f"; the run {result.outcome}: {result.detail}"
    return f"{counted(len(result.wells), 'well')}, {_passed(result)} passed, {found}{ended}"


def _passed(result: DryRun) -> int:
    return sum(row.passed for row in result.wells)


def _run(name: str, **settings: object) -> DryRun:
    from ..dryrun import TRUSTING, DryRunSettings, read_script
    from .dryrun_screen import run_and_show

    package = Path(aegis_ot.__file__).parent
    # In the wheel, and in a checkout.
    places = (package / "demo_protocols" / name, package.parent / "examples" / "demo" / name)
    script = read_script(next((place for place in places if place.exists()), places[0]))
    # The demo plays the operator, who would look at the first well of the clear liquid.
    return run_and_show(script, DryRunSettings(cascade=TRUSTING, **settings))  # type: ignore[arg-type]
