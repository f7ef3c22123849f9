"""``aegis-ot rest``: what a stopped run left."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import ConfigurationError
from ..vocabulary import counted, one_line
from .exit_codes import CLEAN, FINDINGS
from .options import Labware, Parameters
from .paths import write_text
from .plain_text import echo
from .runs import DataFolder, known_run, open_data

if TYPE_CHECKING:
    from ..adapters.opentrons.rehearsal import Recording
    from ..run_view.rest import Rest, RestDelivery

app = typer.Typer()

_STANDS = {"done": "done", "open": "open", "look": "LOOK"}


@app.command()
def rest(
    run: Annotated[str, typer.Argument(help="Which run; the newest if left out.")] = "",
    protocol: Annotated[
        Path | None, typer.Argument(help="The run's protocol: it tells sources and volumes.")
    ] = None,
    data: DataFolder = None,
    as_json: Annotated[Path | None, typer.Option("--json", help="Write it here, as JSON.")] = None,
    block: Annotated[
        Path | None,
        typer.Option(help="Write roles, volumes and open deliveries here, for a protocol."),
    ] = None,
    write: Annotated[
        Path | None, typer.Option(help="Write the protocol that makes the open deliveries here.")
    ] = None,
    again: Annotated[
        list[str] | None,
        typer.Option(
            help="Deliver to this well again, whole, though it is one to look at: 4:B1. Repeatable."
        ),
    ] = None,
    fresh_tips: Annotated[
        bool, typer.Option("--fresh-tips", help="The tip racks are full again.")
    ] = False,
    changed: Annotated[
        bool, typer.Option("--changed", help="Write though the protocol was changed since the run.")
    ] = False,
    parameter: Parameters = None,
    labware: Labware = None,
) -> None:
    """Say what a stopped run left: deliveries done and open, what wells hold, which tips are used.

    A well that failed, is undecided or was not seen is never done: look at it. Nothing is started.
    With --write and a protocol that is a plain list of deliveries, the protocol that makes the open
    ones is written, if Layer 1 has no error in it with what the wells hold now.

    Exit codes: 0 told, or written; 1 that protocol cannot be written, or has an error.
    """
    from ..run_view.plain_protocol import plan_of, rehearsed
    from ..run_view.remaining import rest_of
    from ..sidecar.overview import run_overview
    from ..workbench.files import read_labware, read_values

    if protocol is None and (write or again):
        raise ConfigurationError("--write needs the run's protocol: aegis-ot rest RUN PROTOCOL.")
    if again and not write:
        raise ConfigurationError("--again goes with --write.")
    for path in (write, block, as_json):
        if path is not None and protocol is not None and path.resolve() == protocol.resolve():
            raise ConfigurationError(f"{path} is the run's own protocol; name another file.")
    store = open_data(data)
    overview = run_overview(store, known_run(store, run))
    recording = None
    if protocol is None:
        left = rest_of(overview)
    else:
        recording = rehearsed(protocol, read_labware(labware or ()), read_values(parameter or ()))
        left = rest_of(overview, *plan_of(recording))
    if protocol is not None and recording is not None:
        told = overview.get("protocol_sha256")
        if told and told != hashlib.sha256(recording.text.encode()).hexdigest():
            left.warnings.append(f"{protocol.name} was changed since the run.")
            if write is not None and not changed:
                raise ConfigurationError(
                    f"{protocol} is not what the run ran: it was changed since. Name the file "
                    "that was run (a wrapped one, if it was wrapped), or add --changed if it still "
                    "makes the same deliveries."
                )
    for line in _told(left):
        echo(line)
    if as_json is not None:
        write_text(as_json, left.model_dump_json(indent=1) + "\n")
        echo(f"JSON: {as_json}", err=True)
    if block is not None:
        write_text(block, _block(left, protocol))
        echo(f"{block}: what a protocol that finishes the work has to know.", err=True)
    if write is not None and recording is not None:
        numbers = [_numbered(left, well) for well in again or ()]
        raise typer.Exit(_write(write, recording, left, numbers, fresh_tips))


def _write(
    path: Path, recording: Recording, left: Rest, again: Sequence[int], fresh_tips: bool
) -> int:
    """Write the protocol, if it can be, and Layer 1 has no error in it."""
    from ..run_view.finishing import finishing_protocol
    from ..run_view.plain_protocol import NotPlain
    from ..vocabulary import VerdictWord
    from ..workbench.api import checked_protocol

    try:
        text = finishing_protocol(recording, left, again, fresh_tips)
    except NotPlain as why:
        echo(f"{path} is not written: {why}. --block writes what your protocol has to know.",
             err=True)  # fmt: skip
        return FINDINGS
    checked = checked_protocol(text, path)
    for finding in checked.findings:
        echo(f"  {finding.severity.value} {finding.rule}: {one_line(finding.message)}", err=True)
    if checked.report is None or checked.verdict is VerdictWord.ERROR:
        problem = checked.problem.message if checked.problem else "Layer 1 has an error in it"
        echo(f"{path} is not written: {one_line(problem)}", err=True)
        return FINDINGS
    write_text(path, text)
    echo(f"{path}: written, not started. Layer 1: {checked.verdict.value}. Read it, and compare "
         "the deck with it.", err=True)  # fmt: skip
    return CLEAN


def _block(left: Rest, protocol: Path | None) -> str:
    from ..run_view.finishing import block_of

    text = block_of(left)
    if protocol is None:
        return text
    from ..preflight import load_rules
    from ..workbench.api import checked_protocol
    from ..workbench.roles_template import roles_template

    try:
        return roles_template(checked_protocol(protocol), load_rules()) + "\n" + text
    except ConfigurationError as error:
        return f"# {one_line(error)}\n{text}"


def _numbered(left: Rest, well: str) -> int:
    """The delivery to look at that goes into a well. Raises ConfigurationError."""
    looked = [one for one in left.deliveries if one.standing == "look"]
    found = [
        one
        for one in looked
        if well in one.wells or well in {name.rpartition(":")[2] for name in one.wells}
    ]
    if len(found) != 1:
        known = ", ".join(name for one in looked for name in one.wells) or "none"
        raise ConfigurationError(
            f"--again {well}: {'several deliveries' if found else 'no delivery'} to look at; there "
            f"are {known}."
        )
    return found[0].number


def _told(left: Rest) -> Iterator[str]:
    standings = [one.standing for one in left.deliveries]
    yield (
        f"{one_line(left.run)}: {left.ended or 'not ended'}. {standings.count('done')} done, "
        f"{standings.count('open')} open, {standings.count('look')} to look at."
    )
    for warning in left.warnings:
        yield f"Note: {one_line(warning)}"
    for one in left.deliveries:
        yield f"  {_STANDS[one.standing]:4} {one_line(_delivery(one))}"
    if left.wells:
        yield "Wells hold now:"
    for held in left.wells:
        exact = held.most_ul - held.least_ul <= 0.01
        amount = f"{held.most_ul:g}" if exact else f"{held.least_ul:g} to {held.most_ul:g}"
        unknown = "" if held.began_ul is not None else " against before; nobody told what it held"
        yield f"  {one_line(held.well)}: {amount} µL{unknown}"
    if left.tips:
        yield f"Tips used: {counted(len(left.tips), 'tip')}."
    for tip in left.tips:
        holds = f", last seen with {tip.holds_ul:g} µL of {', '.join(tip.of)}" if tip.of else ""
        times = counted(tip.deliveries, "delivery", "deliveries")
        yield "  " + one_line(f"{tip.tip} ({tip.mount} {tip.pipette}): {times}{holds}")


def _delivery(one: RestDelivery) -> str:
    volume = "" if one.volume_ul is None else f"{one.volume_ul:g} µL "
    source = f"from {', '.join(one.sources)} " if one.sources else ""
    why = f": {one.why}" if one.why else ""
    return f"{one.number:3} {volume}{source}into {', '.join(one.wells) or 'an unknown well'}{why}"
