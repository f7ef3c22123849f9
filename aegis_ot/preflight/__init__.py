"""Layer 1: a protocol is rehearsed, read as a trace, and judged by the rules. Robot side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .judge import Options, Recording, Report, judge
from .recorder import Recorder
from .rulefiles import Database, load_database

if TYPE_CHECKING:
    from ..instrumentation import NameBinding
    from .script import Script

__all__ = [
    "Database",
    "Options",
    "Recorder",
    "Recording",
    "Report",
    "check_recording",
    "check_script",
    "judge",
    "load_database",
    "record",
]


def check_recording(
    recorder: Recorder,
    names: Sequence[NameBinding],
    text: str,
    file_name: str,
    settings: Any = None,
) -> Report:
    """Judge what a recorder heard.

    Args:
        recorder: The recorder, after the run.
        names: Names that held wells.
        text: The protocol's source, ``""`` if it cannot be had.
        file_name: Its name.
        settings: ``aegis_ot.settings.Settings``; ``None`` for defaults.

    Raises:
        RuleError: A rule file cannot be used.
        ConfigurationError: A setting names what does not exist.
    """
    options = Options.from_settings(settings) if settings is not None else Options()
    extra = getattr(settings, "rules_path", None)
    database = load_database([extra] if extra else [])
    recording = Recording(file_name, text, recorder.log, recorder.labware, names)
    return judge(recording, database, options)


def check_script(
    script: Script,
    database: Database | None = None,
    options: Options | None = None,
    timeout_s: float = 120.0,
) -> Report:
    """Rehearse a protocol and judge it.

    Raises:
        RehearsalError: It cannot be rehearsed.
        RuleError: A rule file cannot be used.
    """
    return judge(record(script, timeout_s), database or load_database(), options)


def record(script: Script, timeout_s: float = 120.0) -> Recording:
    """Rehearse a protocol.

    Raises:
        RehearsalError: It cannot be rehearsed.
    """
    from .rehearsal import rehearse

    recorder = Recorder()
    rehearsal = rehearse(script, [recorder], timeout_s=timeout_s)
    return Recording(
        script.file_name, script.text, recorder.log, rehearsal.labware, rehearsal.names
    )
