"""``aegis-ot qualify``: the robot fails on purpose, and what the camera made of it is counted."""

from __future__ import annotations

import json
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..errors import AegisError, ConfigurationError
from .paths import empty_folder, write_text
from .plain_text import echo

if TYPE_CHECKING:
    from ..qualification.plan import QualificationPlan
    from ..sidecar.store import Store

app = typer.Typer()

_HOW, _WHAT, _RESULT = "How to run it (one of)", "What to deliver", "What comes of it"
_FLEX_NAMES = {"p50_single_flex": "flex_1channel_50", "p1000_single_flex": "flex_1channel_1000"}
_PROTOCOL, _CERTIFICATE, _PAGE, _FRAMES = (
    "qualification.py", "certificate.json", "certificate.html", "frames",
)  # fmt: skip


@app.command()
def qualify(
    robot: Annotated[
        str | None, typer.Option(help="Run it on this robot.", rich_help_panel=_HOW)
    ] = None,
    write: Annotated[
        Path | None,
        typer.Option(help="Write the protocol here, for the App.", rich_help_panel=_HOW),
    ] = None,
    simulated: Annotated[
        bool, typer.Option("--simulated", help="On simulated hardware.", rich_help_panel=_HOW)
    ] = False,
    of: Annotated[
        Path | None,
        typer.Option(
            help="The protocol was run from the App: open its plan.", rich_help_panel=_HOW
        ),
    ] = None,
    export: Annotated[
        Path | None,
        typer.Option(
            help="An anonymous archive (.zip) of the frames in --out.", rich_help_panel=_HOW
        ),
    ] = None,
    pipette: Annotated[
        str,
        typer.Option(
            help="right or left with --robot; else as p300_single_gen2:right.",
            rich_help_panel=_WHAT,
        ),
    ] = "",
    liquid: Annotated[
        list[str] | None, typer.Option(help="Repeatable; dye if left out.", rich_help_panel=_WHAT)
    ] = None,
    minutes: Annotated[float, typer.Option(help="Of robot time.", rich_help_panel=_WHAT)] = 30.0,
    volume: Annotated[
        float | None, typer.Option(help="Of each delivery, µL.", rich_help_panel=_WHAT)
    ] = None,
    tips: Annotated[
        str | None, typer.Option(help="Load name of another tip rack.", rich_help_panel=_WHAT)
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option(min=0, help="Of the order; drawn if left out.", rich_help_panel=_WHAT),
    ] = None,
    out: Annotated[
        Path, typer.Option(help="Folder of the result; new or empty.", rich_help_panel=_RESULT)
    ] = Path("qualification"),
    previous: Annotated[
        Path | None, typer.Option(help="Compare with this certificate.", rich_help_panel=_RESULT)
    ] = None,
    licence: Annotated[
        str, typer.Option(help="Licence line of the archive.", rich_help_panel=_RESULT)
    ] = "",
    run: Annotated[
        str, typer.Option(help="With --of: which run; else the newest of that protocol.")
    ] = "",
    data: Annotated[
        Path | None, typer.Option(help="Data folder of the sidecar; its usual one if left out.")
    ] = None,
    sidecar: Annotated[str | None, typer.Option(help="Its address, as the robot sees it.")] = None,
    token: Annotated[
        str | None, typer.Option(help="Its token; the protocol then holds it.")
    ] = None,
    yes: Annotated[bool, typer.Option("--yes", "-y", help="Start without asking.")] = False,
) -> None:
    """Let the robot fail on purpose, and count what its camera catches.

    The sidecar judges blind; the plan is opened after the run. It takes one rack, one reservoir
    and one plate. Nothing leaves this machine by itself.

    Exit codes: 0 done, 1 the robot did not finish it, 2 it cannot be done.
    """
    ways = [robot is not None, write is not None, simulated, of is not None, export is not None]
    if sum(ways) != 1:
        raise ConfigurationError("Say how: one of --robot, --write, --simulated, --of or --export.")
    if export is not None:
        _export(out, export, licence)
        return
    told = None if previous is None else _certificate_in(previous)
    if of is not None:
        plan, store, named = _run_from_app(of, data, run)
        empty_folder(out)
        _finish(plan, store, named, out, told)
        return
    plan = _plan(robot, pipette, liquid or ["dye"], minutes, seed, volume, tips)
    if robot is None:
        _rehearse(plan)
    settings = _given(sidecar, token)
    if simulated and settings:
        raise ConfigurationError("--simulated has a sidecar of its own: no --sidecar, no --token.")
    if write is not None:
        _write_protocol(write, plan, settings)
        if sidecar is None:
            echo("Its guard takes the robot's own settings of a sidecar; --sidecar writes one in.")
        return
    known: set[str] = set()
    if robot is not None:
        # What the robot is set to, this machine cannot see: the protocol says who watches.
        settings = _given(*_watching(sidecar, token))
        known = _runs_in(data)
    empty_folder(out)
    _write_protocol(out / _PROTOCOL, plan, settings)
    if simulated:
        from ..qualification.running import run_simulated
        from ..sidecar.store.opening import open_store

        folder = out / "run"
        named = run_simulated(plan, folder, plan.seed)
        _finish(plan, open_store(folder), named, out, told)
        return
    assert robot is not None
    _run_on(robot, out / _PROTOCOL, settings, yes)
    plan, store, named = _run_from_app(out / _PROTOCOL, data, "", known)
    _finish(plan, store, named, out, told)


def _plan(
    robot: str | None, pipette: str, liquids: list[str], minutes: float, seed: int | None,
    volume: float | None, tips: str | None,
) -> QualificationPlan:  # fmt: skip
    from ..qualification.plan import make_plan

    name, _, mount = pipette.rpartition(":")
    if mount not in ("left", "right") or (not name and robot is None):
        raise ConfigurationError(
            "--pipette is right or left with --robot, else a name and a mount: "
            "--pipette p300_single_gen2:right"
        )
    if not name and robot is not None:
        from ..robot import RobotClient

        with RobotClient(robot) as client:
            there = client.pipettes()
        if mount not in there:
            raise ConfigurationError(f"{robot} has no pipette on its {mount} mount.")
        name = _FLEX_NAMES.get(there[mount], there[mount])
    return make_plan(name, mount, liquids, minutes, seed, volume, tips)


def _write_protocol(path: Path, plan: QualificationPlan, settings: dict[str, Any]) -> None:
    from ..qualification.protocol import protocol_text

    if path.exists():
        raise ConfigurationError(
            f"{path} is there already. A run is opened with the file that was run: name a new one."
        )
    write_text(path, protocol_text(plan, settings))
    echo(
        f"{path}: {len(plan.deliveries)} deliveries of {plan.volume_ul:g} µL, "
        f"{sum(bool(each.fault) for each in plan.deliveries)} of them faults. Its head says what "
        "the deck needs. Do not read its plan before the run is over."
    )


def _rehearse(plan: QualificationPlan) -> None:
    """Refuse what a robot would refuse, as tips of another name, where there is an opentrons."""
    from ..adapters.opentrons.rehearsal import Script, record
    from ..qualification.protocol import protocol_text
    from ..workbench.engines import EngineMissing, engine_for, need_of

    text = protocol_text(plan)
    try:
        if not engine_for(need_of(text)).python:
            record(Script(text, _PROTOCOL))
    except EngineMissing:
        pass


def _given(sidecar: str | None, token: str | None) -> dict[str, str]:
    return {name: v for name, v in (("sidecar", sidecar), ("token", token)) if v}


def _watching(sidecar: str | None, token: str | None) -> tuple[str, str | None]:
    """The sidecar's address and token. Half an hour that nobody watches would be for nothing."""
    from .robots import sidecar_of

    url, secret = sidecar_of(sidecar, token)
    if url is None:
        raise ConfigurationError(
            "Nobody would watch it. Say where the sidecar is, as the robot sees it: "
            "--sidecar http://192.168.1.20:7645"
        )
    return url, secret


def _runs_in(data: Path | None) -> set[str]:
    from .runs import open_data

    return {str(row["run"]) for row in open_data(data).runs()}


def _run_on(robot: str, protocol: Path, settings: dict[str, Any], yes: bool) -> None:
    """Raises typer.Exit where the robot did not finish it; wells that failed are as planned."""
    from ..robot.preparing import Inputs
    from .exit_codes import FINDINGS
    from .robots import not_yet_run, run_protocol

    result = not_yet_run(protocol)
    watched_by = settings["sidecar"], settings.get("token")
    try:
        run_protocol(result, protocol, robot, Inputs(), *watched_by, yes=yes)
    except typer.Exit:
        pass
    except AegisError as error:
        if not result.id:
            raise
        echo(str(error), err=True)
    finally:
        if not result.id:
            protocol.unlink(missing_ok=True)  # the next try may have this folder
    if result.status == "succeeded":
        return
    echo(
        f"The robot did not finish it ({result.status}). Once its run is over, open what was done: "
        f"aegis-ot qualify --of {protocol} --out {protocol.parent}-opened"
        if result.id
        else "It was not run; there is nothing to open."
    )
    raise typer.Exit(FINDINGS)


def _run_from_app(
    protocol: Path, data: Path | None, run: str, known: Collection[str] | None = None
) -> tuple[QualificationPlan, Store, str]:
    """The plan of a protocol, and the run of it in the store: none of those ``known`` before it."""
    from ..qualification.plan import plan_in
    from .runs import known_run, open_data

    try:
        text = protocol.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"Cannot read the protocol {protocol}: {error}.") from None
    plan = plan_in(text, str(protocol))
    store = open_data(data)
    if run:
        return plan, store, known_run(store, run)
    alike = [row for row in store.runs() if plan.mark in row["title"]]
    meant = [
        row for row in alike if (not row["simulated"] if known is None else row["run"] not in known)
    ]
    if not meant:
        only = ""
        if alike and known is None:
            only = f" but a simulated one (--run {alike[0]['run']} opens it)"
        raise ConfigurationError(
            f"{store.folder} holds no run of the plan in {protocol}{only}: the sidecar that "
            "watched it keeps its data elsewhere (--data), or another file was run (--of)."
        )
    return plan, store, str(meant[0]["run"])


def _certificate_in(path: Path) -> dict[str, Any]:
    from ..qualification.certificate import check_certificate

    try:
        told = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ConfigurationError(f"Cannot read the certificate {path}: {error}.") from None
    check_certificate(told)
    return dict(told)


def _finish(
    plan: QualificationPlan, store: Store, run: str, out: Path, previous: dict[str, Any] | None
) -> None:
    from ..qualification.certificate import certificate, certificate_html
    from ..qualification.fitted import before_and_after, flagged_anew, judge_anew
    from ..qualification.frames import true_samples, write_frames
    from ..qualification.opening import open_plan
    from ..vision.detection import HeatmapDetector
    from .progress import StageBar

    detector = HeatmapDetector()
    open_plan(store, run, plan)  # before minutes are spent on it
    with StageBar() as shown:
        samples, source = true_samples(store, run, plan, detector)
        write_frames(out / _FRAMES, samples, source)
        shipped = judge_anew(samples, shown)
        made = certificate(store, run, plan, detector, previous, flagged_anew(shipped))
        made["fitted"] = before_and_after(samples, shipped, shown)
    write_text(out / _CERTIFICATE, json.dumps(made, indent=1, ensure_ascii=False) + "\n")
    write_text(out / _PAGE, certificate_html(made))
    for line in _lines(made):
        echo(line)
    echo(f"Page: {out / _PAGE}; frames with true labels: {out / _FRAMES}")


def _lines(made: dict[str, Any]) -> list[str]:
    lines = []
    for one in made["liquids"]:
        caught, flagged, least = one["caught"], one["normals_flagged"], one["smallest_leftover"]
        lines.append(
            f"{one['name']}: {caught['hits']} of {caught['of']} faults caught, "
            f"{flagged['hits']} of {flagged['of']} normal wells flagged ({made['frames']} frames)."
        )
        if least:
            share, less = least["share"], least["share"] == least["planted"]
            lines.append(
                "  Not even the whole volume left in the tip is caught nine times in ten."
                if share is None
                else f"  Caught nine times in ten: from {share * made['volume_ul']:.3g} µL"
                f"{' or less' if less else ''} left."
            )
        elif one["no_smallest"]:
            lines.append(f"  {one['no_smallest']}")
    return [*lines, *made["advice"], *made["changes"]]


def _export(out: Path, archive: Path, licence: str) -> None:
    from ..qualification.frames import export_archive
    from .paths import open_dataset

    count = export_archive(open_dataset(out / _FRAMES), archive, licence)
    echo(f"{archive}: {count} deliveries, cut to the tip, without names, places or dates.")
