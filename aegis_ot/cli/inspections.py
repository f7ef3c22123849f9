"""``aegis-ot inspect``: a page to look at a data set or a run, well by well."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import ConfigurationError
from ..vocabulary import counted
from .commands import joined
from .paths import open_dataset, tip_finder, write_text
from .plain_text import echo

if TYPE_CHECKING:
    from ..inspection import Inspection
    from ..progress import Progress


app = typer.Typer()


@app.command("inspect")
def inspect_wells(
    what: Annotated[
        str,
        typer.Argument(
            help="Folder of a data set, data folder of a sidecar, or a run in its usual one."
        ),
    ],
    out: Annotated[Path, typer.Option("--out", "-o", help="The page.")] = Path("inspect.html"),
    run: Annotated[
        str | None, typer.Option(help="Which run of a sidecar's folder; the newest if left out.")
    ] = None,
    scorer: Annotated[str, typer.Option(help="Scorer of a data set.")] = "ensemble",
    world_model: Annotated[
        Path | None,
        typer.Option(help="Score a data set with this model (aegis-ot fit), not plate by plate."),
    ] = None,
    boxes: Annotated[
        str, typer.Option(help="Of a data set: detector, true (boxes.csv), or an .onnx file.")
    ] = "detector",
    most: Annotated[
        int, typer.Option(min=0, help="Wells with pictures; flagged ones come first.")
    ] = 200,
) -> None:
    """Write a page that shows frames, boxes, columns, scores and routes, well by well.

    Each well has its four frames, the tip found, the measured column against the expected one,
    its score, its route and its verdict. The page holds everything and needs no network.

    Exit codes: 0 written, 2 there is nothing to show, or it cannot be read.
    """
    from ..inspection import inspection_html
    from .progress import StageBar

    with StageBar() as shown:
        folder = Path(what)
        if folder.exists() and not _is_store(folder):
            inspection = _dataset(folder, scorer, world_model, boxes, most, shown)
        else:
            inspection = _run(what, run, most, shown)
    page = inspection_html(inspection)
    write_text(out, page)
    flagged = sum(well.flagged for well in inspection.wells)
    echo(
        f"{out}: {counted(len(inspection.wells), 'well')} ({inspection.source} frames), "
        f"{flagged} flagged; {len(page.encode()) / 1e6:.1f} MB."
    )


def _is_store(folder: Path) -> bool:
    from ..sidecar.store.opening import is_store

    return is_store(folder)


def _dataset(
    folder: Path, scorer: str, world_model: Path | None, boxes: str, most: int, shown: Progress
) -> Inspection:
    """A data set is judged anew, which is the laboratory's to do."""
    inspect_dataset = joined("dataset", "aegis_ot.inspections")
    from ..sidecar.analysers import load_scorer

    fitted = None if world_model is None else load_scorer(world_model)
    data = open_dataset(folder)
    inspection: Inspection = inspect_dataset(
        data, scorer.replace("-", "_"), fitted, tip_finder(boxes), most, shown
    )
    return inspection


def _run(what: str, run: str | None, most: int, shown: Progress) -> Inspection:
    from ..inspection import inspect_run
    from ..sidecar import SidecarConfig
    from ..sidecar.store.opening import open_store
    from ..sidecar.token_file import known_token

    folder = Path(what)
    if not folder.exists():
        folder, run = SidecarConfig.load(find_token=known_token).data, what
        if not _is_store(folder):
            raise ConfigurationError(
                f"{what} is no folder, and there is no sidecar's store in {folder} in which it "
                "could be a run."
            )
    store = open_store(folder)
    known = [str(row["run"]) for row in store.runs()]
    if not known:
        there = f"{what} is no folder, and " if run else ""
        raise ConfigurationError(f"{there}{folder} holds no run yet.")
    if run is not None and run not in known:
        raise ConfigurationError(
            f"{run!r} is neither a folder nor a run in {folder}; its newest runs are "
            f"{', '.join(known[:10])}."
        )
    return inspect_run(store, run or known[0], most, shown)
