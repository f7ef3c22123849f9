"""``aegis-ot audit``: the look back at a run."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import ConfigurationError
from ..vocabulary import counted
from .exit_codes import BROKEN, CLEAN, FINDINGS
from .models import ModelName, RecordFolder, backend_of
from .paths import tip_finder, write_text
from .plain_text import echo
from .runs import DataFolder, known_run, open_data

if TYPE_CHECKING:
    from ..audit import Audit
    from ..audit.plate_pictures import PlateAudit
    from ..reports.plate_views import PlateViews
    from ..sidecar.store import Store
    from ..vision.gates import ConfirmingGate


app = typer.Typer()


@app.command()
def audit(
    run: Annotated[str, typer.Argument(help="Which run; the newest if left out.")] = "",
    data: DataFolder = None,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Write the page here.")] = None,
    as_json: Annotated[Path | None, typer.Option("--json", help="Write it here, as JSON.")] = None,
    world_model: Annotated[
        Path | None, typer.Option(help="World model of the lab, written by aegis-ot fit.")
    ] = None,
    boxes: Annotated[
        str, typer.Option(help="What finds the tips: detector, or an .onnx file.")
    ] = "detector",
    model: ModelName = None,
    record: RecordFolder = None,
    budget: Annotated[
        float | None, typer.Option(min=0, help="What a model may cost, in the prices' currency.")
    ] = None,
    calls: Annotated[
        int | None, typer.Option(min=0, help="How often a model may be asked; 10 if left out.")
    ] = None,
    plate: Annotated[
        tuple[Path, Path] | None,
        typer.Option(
            help="Two pictures of a plate from above, before and after the run.",
            metavar="BEFORE AFTER",
        ),
    ] = None,
    plate_slot: Annotated[
        str, typer.Option(help="Slot or label of that plate, where the run filled several.")
    ] = "",
    plate_wells: Annotated[
        int | None, typer.Option(help="How many wells it has, where its name does not tell.")
    ] = None,
    a1: Annotated[
        list[str] | None,
        typer.Option(
            help="Corner of the pictures where A1 is: top-left, top-right, bottom-left "
            "or bottom-right. Twice if it differs, before and after."
        ),
    ] = None,
) -> None:
    """Read every well of a finished run again with all that the run tells, and rank what passed.

    It finds what the run itself could not see: faults among the first wells, a slow drift, a
    source that was empty from the first well on. The result is kept with the run and shown on
    its page. With a model, the silent passes are shown to it in their order, as far as the budget
    goes. With two pictures of a plate, what changed in its wells is compared with what the run put
    into them.

    Exit codes: 0 nothing stands out, 1 a person should look, 2 the run cannot be audited.
    """
    from dataclasses import replace

    from ..audit import audit_run
    from ..audit.models import world_model as load_world_model
    from ..reports.audit_html import audit_html
    from ..sidecar.overview import run_overview
    from ..vision.detection import load_detector
    from .progress import StageBar

    gate = _gate(model, record, budget, calls)
    detector, scorer = load_detector(tip_finder(boxes)), load_world_model(world_model)
    store = open_data(data)
    name = known_run(store, run)
    if not (store.run(name) or {}).get("finished"):
        raise ConfigurationError(f"Run {name} has not ended yet; it is audited when it has.")
    seen, views = _pictured(store, name, plate, plate_slot, plate_wells, a1 or ())
    with StageBar() as shown:
        found = audit_run(store, name, detector, scorer, gate, shown)
    kept = (store.audit(name) or {}).get("plate")
    found = replace(found, plate=kept if seen is None else seen.to_json())
    store.add_audit(name, found.to_json())
    _tell(found)
    if seen is not None:
        _tell_plate(seen)
    if out is not None:
        overview = run_overview(store, name)
        page = audit_html(overview, found.to_json(), store.frames_of(name), views)
        write_text(out, page)
        echo(f"Page: {out}", err=True)
    if as_json is not None:
        write_text(as_json, json.dumps(found.to_json(), ensure_ascii=False, indent=1) + "\n")
        echo(f"JSON: {as_json}", err=True)
    if not found.wells and seen is None:
        raise typer.Exit(BROKEN)
    stands_out = bool(found.standing_out) or (seen is not None and seen.stands_out)
    raise typer.Exit(FINDINGS if stands_out else CLEAN)


def _pictured(
    store: Store,
    run: str,
    plate: tuple[Path, Path] | None,
    slot: str,
    wells: int | None,
    a1: Sequence[str],
) -> tuple[PlateAudit | None, PlateViews | None]:
    """What the pictures say, and what the page shows of them; nothing if none are given.

    Raises:
        ConfigurationError: An option makes no sense, or the pictures cannot be read.
    """
    from ..audit.plate_pictures import CORNERS, compare_pictures, read_picture
    from ..audit.plate_record import recorded_plate
    from ..reports.plate_views import plate_views
    from ..sidecar.overview import run_overview

    if plate is None:
        if slot or wells is not None or a1:
            raise ConfigurationError(
                "--plate-slot, --plate-wells, --a1: no pictures are given. Give two with --plate."
            )
        return None, None
    if len(a1) > 2 or set(a1) - set(CORNERS):
        raise ConfigurationError(f"--a1 is one of {', '.join(CORNERS)}, once or twice.")
    recorded = recorded_plate(run_overview(store, run)["trajectories"], slot, wells)
    before, after = (read_picture(path, recorded.plate) for path in plate)
    said = compare_pictures(before, after, recorded, a1)
    pictured = (before.image, before.found), (after.image, after.found)
    return said, plate_views(*pictured, said.to_look_at)


def _gate(
    model: str | None, record: Path | None, budget: float | None, calls: int | None
) -> ConfirmingGate | None:
    """The vision model, if one is named, with what it may take.

    Raises:
        ConfigurationError: A budget without a model, or its name makes no sense.
    """
    backend = backend_of(model, record)
    if backend is None:
        if budget is not None or calls is not None:
            raise ConfigurationError("--budget, --calls: no model is asked. Name one with --model.")
        return None
    from ..llm import load_prices
    from ..llm.gate_tiers import Budget, VlmTiers

    asked = 10 if calls is None and budget is None else calls
    return VlmTiers([backend], load_prices(), Budget(budget, asked))


def _tell_plate(seen: PlateAudit) -> None:
    echo(
        f"{seen.title}, {seen.before} and {seen.after}: {counted(len(seen.wells), 'well')}, "
        f"{counted(seen.counted('agrees'), 'agrees', 'agree')} with the record, "
        f"{counted(seen.counted('contradicts'), 'contradicts', 'contradict')} it, "
        f"{seen.counted('unjudged')} not judged."
    )
    for said in (seen.doubt, *seen.contradictions, *seen.notes):
        if said:
            echo(f"  {said}")


def _tell(audit: Audit) -> None:
    out = audit.standing_out
    if not audit.wells:
        echo(f"{audit.run}: no delivery could be audited.")
    else:
        echo(
            f"{audit.run}: {counted(audit.wells, 'well')} on {audit.frames} frames, "
            f"{counted(audit.silent, 'silent pass', 'silent passes')}; "
            f"{'none stands out' if not out else f'{len(out)} to look at'}."
        )
    for note in audit.notes:
        echo(note)
    for rank, one in enumerate(audit.suspects, 1):
        if one.stands_out:
            where = one.wells[0] if one.kind == "well" else f"{len(one.wells)} wells"
            echo(f"  {rank}. {where} (score {one.score:.1f})")
            for said in one.why:
                echo(f"     {said}")
