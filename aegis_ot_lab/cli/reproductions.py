"""``aegis-ot reproduce``: every table and figure of the paper, measured again."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from aegis_ot.cli.exit_codes import BROKEN, CLEAN
from aegis_ot.cli.models import RecordFolder, backend_of
from aegis_ot.cli.options import one_of
from aegis_ot.cli.paths import open_dataset, write_text
from aegis_ot.workbench.given import split

from .options import ModelNames, writable_folder

if TYPE_CHECKING:
    from ..reproduction import Entry

PAGE, DATA = "reproduction.html", "reproduction.json"


app = typer.Typer()


@app.command()
def reproduce(
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder for page, JSON and pictures.")],
    only: Annotated[
        list[str] | None,
        typer.Option(help="Experiments by name; repeatable, or a comma list (all if left out)."),
    ] = None,
    data: Annotated[
        list[Path] | None,
        typer.Option(help="Trajectory data set in a simulated one's place; repeatable."),
    ] = None,
    model: ModelNames = None,
    record: RecordFolder = None,
    seed: Annotated[int, typer.Option(min=0, help="Of everything that is drawn.")] = 0,
    plates: Annotated[int, typer.Option(min=4, max=200, help="Of a simulated data set.")] = 16,
    replicates: Annotated[
        int, typer.Option(min=1, max=100, help="Runs in each cell of the live matrix.")
    ] = 5,
    wells: Annotated[
        int, typer.Option(min=12, max=96, help="Of the plate that costs are measured on.")
    ] = 96,
    again: Annotated[
        bool, typer.Option("--again", help="Run what is finished already, too.")
    ] = False,
) -> None:
    """Measure every table and figure of the paper again, and show ours beside the paper's.

    Finished experiments are kept in --out, and taken up if version, seed and options are the
    same: after an interruption, run the same command. Without --data, simulated sets are made.

    Exit codes: 0 all were run, 2 one failed (the page says why), or an option is no good.
    """
    from aegis_ot.cli.progress import StageBar

    from ..reproduction import EXPERIMENTS, Context, ReproductionOptions, reproduce

    names = [one.name for one in EXPERIMENTS]
    chosen = [one_of("--only", name, names) for name in split("--only", only) or names]
    asked: Sequence[str | None] = model or (None,)
    backends = [one for name in asked if (one := backend_of(name, record)) is not None]
    folders = tuple(open_dataset(folder).root for folder in data or ())
    writable_folder(out)
    options = ReproductionOptions(
        out,
        seed,
        folders,
        tuple(backend.name for backend in backends),
        plates,
        replicates,
        wells,
    )
    if again:
        for name in chosen:
            (out / "experiments" / f"{name}.json").unlink(missing_ok=True)
    with StageBar() as shown:
        context = Context(options, backends, shown)
        _ = context.given  # a set that cannot be used is told before anything is run
        entries = reproduce(EXPERIMENTS, chosen, context, _tell, lambda all_: _write(all_, out))
    typer.echo(f"{out / PAGE} and {DATA} beside it")
    failed = any(entry.state == "failed" for entry in entries)
    raise typer.Exit(BROKEN if failed else CLEAN)


def _tell(entry: Entry) -> None:
    took = "kept from before" if entry.taken_up else f"{entry.seconds:.0f} s"
    problem = f": {entry.problem}" if entry.problem else ""
    typer.echo(f"{entry.experiment.name:12} {entry.state}, {took}{problem}")


def _write(entries: Sequence[Entry], out: Path) -> None:
    from ..reproduction import as_json, reproduction_html, reproduction_json

    write_text(out / PAGE, reproduction_html(entries, out))
    write_text(out / DATA, as_json(reproduction_json(entries)))
