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


app = typer.Typer()


@app.command()
def demo(
    out: Annotated[Path, typer.Option(help="Folder for the report.")] = Path("out"),
) -> None:
    """Show a protocol rejected, a run watched, and a run paused at the failed well."""
    from .dryrun_screen import console, write_report

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
        (rejected.outcome == "rejected", f"{_REJECTED}: rejected before anything moved"),
        (
            watched.outcome == "succeeded" and not watched.flagged,
            f"{_LONG}: {counted(len(watched.wells), 'well')}, {_passed(watched)} passed, "
            "no false alarm",
        ),
        (
            paused.outcome == "stopped"
            and [row.well.split()[0] for row in paused.flagged] == ["D4"]
            and not paused.touched_after_failure,
            f"{_LONG} with {_FAULT}: paused at D4, no further well touched",
        ),
    ]
    for as_told, line in told:
        console.print(("  caught  " if as_told else "  MISSED  ") + line, markup=False)
    if not all(as_told for as_told, _ in told):
        raise typer.Exit(BROKEN)


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
