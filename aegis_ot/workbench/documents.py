"""Judges JSON files: Protocol Designer's, which Opentrons' own engine runs, and analyses."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import ConfigurationError
from ..preflight import Options, Report, RuleSet
from .designer_steps import steps_of
from .engines import FLEX, OT2, Need, engine_for
from .result import CheckedProtocol

if TYPE_CHECKING:
    from .side_by_side import LazyRehearser

UNIT = "command"
"""What a finding in such a file cites."""

_OLDEST_SCHEMA = 6
_LARGEST_BYTES = 200_000_000
_MARKS = (b'"designerApplication"', b'"commandType"')


def is_document(path: Path) -> bool:
    """Whether a JSON file is one that can be judged, as far as its text shows."""
    try:
        data = path.read_bytes() if path.stat().st_size <= _LARGEST_BYTES else b""
    except OSError:
        return False
    return any(mark in data for mark in _MARKS)


def read_document(path: Path) -> Mapping[str, Any]:
    """The content of a Protocol Designer file or an analysis.

    Raises:
        ConfigurationError: It cannot be read, or is neither; the message does not name the file.
    """
    try:
        found = json.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise ConfigurationError(f"cannot be read: {error.strerror}.") from None
    except (ValueError, RecursionError) as error:
        raise ConfigurationError(f"is no JSON: {error}.") from None
    if isinstance(found, dict) and isinstance(found.get("data"), dict):
        found = found["data"]  # as the robot's server answers
    if not isinstance(found, dict) or not isinstance(found.get("commands"), (list, dict)):
        raise ConfigurationError(
            "is JSON, but neither of Protocol Designer nor an analysis (opentrons analyze "
            "--json-output); definitions of labware are given with --labware."
        )
    schema = found.get("schemaVersion")
    if is_designers(found) and not (isinstance(schema, int) and schema >= _OLDEST_SCHEMA):
        raise ConfigurationError(
            f"is of an old Protocol Designer (schema {schema}); open it in today's, and export it "
            "again."
        )
    return found


def is_designers(document: Mapping[str, Any]) -> bool:
    """Whether Opentrons' engine has to run it; an analysis tells what came of that."""
    return "schemaVersion" in document or "designerApplication" in document


def need_of_document(path: Path) -> Need | None:
    """What runs a Protocol Designer file; ``None`` for anything else."""
    try:
        document = read_document(path) if path.suffix.lower() == ".json" else {}
    except ConfigurationError:  # told when it is judged
        return None
    return _need(document) if is_designers(document) else None


def _need(document: Mapping[str, Any]) -> Need:
    model = str((document.get("robot") or {}).get("model", OT2))
    return Need(OT2, (2, 0)) if model.startswith(OT2) else Need(FLEX, (2, 15))


@dataclass(frozen=True)
class Analyse:
    """Have Opentrons run a Protocol Designer file (it takes Python, too), and tell its commands
    with their results."""

    text: str
    file_name: str
    timeout_s: float

    def perform(self) -> dict[str, Any]:
        """Run ``opentrons analyze``."""
        from opentrons.cli.analyze import analyze

        with tempfile.TemporaryDirectory(prefix="aegis-ot-") as folder:
            file = Path(folder, "protocol").with_suffix(Path(self.file_name).suffix)
            out = Path(folder, "analysis")
            file.write_text(self.text, encoding="utf-8")
            with contextlib.suppress(SystemExit):  # its way to return; errors are in what it wrote
                analyze.main([f"--json-output={out}", str(file)], standalone_mode=False)
            found: dict[str, Any] = json.loads(out.read_text(encoding="utf-8"))
            return found


def check_document(
    file: Path,
    options: Options,
    timeout_s: float,
    robot_version: str,
    rule_set: RuleSet,
    rehearser: LazyRehearser,
) -> CheckedProtocol:
    """Judge a JSON file by the commands in it.

    Raises:
        ConfigurationError: It cannot be judged; the message does not name the file.
        TaskFailed: Opentrons' engine does not run it.
    """
    start = time.monotonic()
    document = given = read_document(file)
    notes = []
    if is_designers(document):
        engine = engine_for(_need(document), robot_version)
        task = Analyse(json.dumps(document), file.name, timeout_s)
        document = {"liquids": [], **rehearser.get(engine).perform(task)}
        notes.append(f"run by Opentrons' engine, opentrons {engine.version}.")
    began = time.monotonic()
    for error in document.get("errors") or ():
        if document.get("result") != "ok":
            raise ConfigurationError(
                f"Opentrons' analysis of it failed: {error.get('detail') or error.get('errorType')}"
            )
    from ..preflight import Interpretation, judge
    from .commands import recording_of
    from .playback import playback_of

    try:
        recording, lines = recording_of(document, file.name)
        steps = steps_of(given, document["commands"])
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        told = f"its commands cannot be read: {type(error).__name__}: {error}"
        raise ConfigurationError(told) from None
    reading = Interpretation(recording, rule_set, options)
    report = judge(reading)
    ended = time.monotonic()
    if document.get("status") in ("failed", "stopped"):
        notes.append(f"the run {document['status']}; judged up to command {len(lines)}, its last.")
    report = dataclasses.replace(
        _citing_commands(report), file=file.name, notes=(*report.notes, *notes)
    )
    return CheckedProtocol(
        file.as_posix(),
        report=report,
        lines=lines,
        playback=playback_of(reading, report),
        unit=UNIT,
        steps=steps,
        declared=(),
        seconds=ended - start,
        rehearsal_s=began - start,
        verdict_s=ended - began,
    )


def _citing_commands(report: Report) -> Report:
    """The same, with commands where its words speak of lines."""

    def cite(text: str) -> str:
        return text.replace("at line ", f"at {UNIT} ")

    findings = [
        dataclasses.replace(one, message=cite(one.message), fix=cite(one.fix))
        for one in report.findings
    ]
    return dataclasses.replace(report, findings=tuple(findings))
