"""Checks many protocol files by the same settings, each rehearsed in a process of its own."""

from __future__ import annotations

import dataclasses
import functools
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..adapters.opentrons.rehearsal import Script
from ..errors import AegisError, ConfigurationError, RehearsalError
from ..preflight import Options, RuleSet
from ..preflight.source import source_lines
from ..settings import Settings
from ..vocabulary import Finding, Remark
from .baseline import Baseline
from .configuration import ConfiguredWaiver
from .documents import check_document
from .engines import EngineMissing, engine_for, need_of
from .exploring import explore
from .files import as_protocol, read_protocol
from .guard_arguments import GuardArguments, guard_arguments
from .problems import lacks_labware, with_helper
from .project_waivers import waive, with_stale_waivers
from .reaching import reaches
from .rehearser import Rehearser, TaskFailed
from .result import CheckedProtocol, Problem, with_findings
from .shelf import Definition, definitions_below, named_in, with_own_values
from .side_by_side import LazyRehearser, RehearserPool, check_each
from .surroundings import Placed, Surroundings, root_of, surroundings_of
from .tasks import CheckTask, Describe, Examined
from .with_model import Asking, ask_model


@dataclass(frozen=True)
class CheckSettings:
    """How to check.

    Attributes:
        options: How to judge; what a guard in a protocol says fills what they leave open.
        rules: Files or folders of further rules.
        parameters: Values for runtime parameters.
        csv_parameters: Files for CSV runtime parameters.
        labware: Custom labware definitions, by URI.
        timeout_s: Longest rehearsal of one protocol, s.
        all_parameters: Whether to try all values of runtime parameters.
        waivers: Of the project's configuration.
        waiver_root: Folder that the waivers' file patterns are relative to.
        baseline: Findings known of old.
        explain_roles: Whether the reports are to show roles.
        asking: A model to ask, if any.
        jobs: How many files to check at a time; one where a model is asked.
        shelves: Folders in which, beside the working folder, a protocol's modules are looked for
            where it lies in no checkout.
        definitions: Finds custom labware below the root of a checkout, where some lacks.
        robot_version: Of the robot that the protocols are for; ``""`` where none is named.
        playback: Whether the reports are to play the rehearsal.
        pool: Keeps the rehearsing processes for the next call.
        texts: Texts that an editor has not saved yet, by file: they go before what is on the disk.
    """

    options: Options = field(default_factory=Options)
    rules: tuple[str, ...] = ()
    parameters: Mapping[str, Any] = field(default_factory=dict)
    csv_parameters: Mapping[str, Path] = field(default_factory=dict)
    labware: Mapping[str, Any] = field(default_factory=dict)
    timeout_s: float = 120.0
    all_parameters: bool = False
    waivers: tuple[ConfiguredWaiver, ...] = ()
    waiver_root: Path = field(default_factory=Path)
    baseline: Baseline | None = None
    explain_roles: bool = False
    asking: Asking | None = None
    jobs: int = 1
    shelves: tuple[Path, ...] = ()
    definitions: Callable[[Path], Sequence[Definition]] = definitions_below
    robot_version: str = ""
    texts: Mapping[Path, str] = field(default_factory=dict)
    playback: bool = False
    pool: RehearserPool | None = None


def check_alike(
    files: Sequence[Path],
    settings: CheckSettings,
    rule_set: RuleSet,
    done: Callable[[CheckedProtocol], None] = lambda checked: None,
) -> list[CheckedProtocol]:
    """Check protocol files by the same settings. A bad one does not keep the others from it.

    Args:
        files: Protocol files.
        settings: How to check.
        rule_set: The rules in force, with ``settings.rules``.
        done: Told of each file, in their order, when it is done.

    Raises:
        RehearsalError: The rehearsing process cannot be started.
    """
    settings = dataclasses.replace(settings, definitions=functools.cache(settings.definitions))

    def check(file: Path, rehearser: LazyRehearser) -> CheckedProtocol:
        return check_file(file, settings, rule_set, rehearser)

    # One question at a time to a model: its service counts them.
    jobs = settings.jobs if settings.asking is None else 1
    protocols = check_each(files, jobs, settings.rules, check, done, settings.pool)
    return with_stale_waivers(protocols, settings.waivers, settings.waiver_root)


def check_file(
    file: Path, settings: CheckSettings, rule_set: RuleSet, rehearser: LazyRehearser
) -> CheckedProtocol:
    """Check one protocol where it lies."""
    name = file.as_posix()
    if file.suffix.lower() == ".json" and file.is_file():
        return _check_document(file, settings, rule_set, rehearser)
    try:
        unsaved = settings.texts.get(file)
        text = read_protocol(file) if unsaved is None else as_protocol(unsaved)
        whole = with_own_values(file, text)
    except ConfigurationError as error:
        return CheckedProtocol(name, problem=Problem(str(error)))
    except RehearsalError as error:
        return CheckedProtocol(name, problem=Problem(str(error), error.line))
    lines = tuple(source_lines(text))
    root = root_of(file, (*settings.shelves, Path.cwd()))
    around = surroundings_of(file, text, root)
    script: Script = Placed(
        text=whole,
        file_name=file.name,
        parameters=settings.parameters,
        csv_parameters={name: str(path) for name, path in settings.csv_parameters.items()},
        extra_labware=settings.labware,
        folder=str(file.resolve().parent),
        modules=around.modules,
    )
    try:
        said = guard_arguments(text)
        options = options_for(said, settings.options)
    except ConfigurationError as error:
        return CheckedProtocol(name, problem=Problem(str(error)), lines=lines)
    if options.leave_none(rule_set):
        told = "no rule is left to judge it by, with what its guard selects and ignores."
        return CheckedProtocol(name, problem=Problem(told), lines=lines)
    try:
        engine = engine_for(need_of(text), settings.robot_version)
        process = rehearser.get(engine)
        process.get_ready()
    except (EngineMissing, RehearsalError) as error:
        return CheckedProtocol(name, problem=Problem(str(error), error.line), lines=lines)
    version = engine.version if engine.python else ""
    start = time.monotonic()
    script, declared = _with_own_values(process, script, settings.timeout_s)
    try:
        judged = _judge_in(root, around, settings, process, script, options, rule_set)
    except TaskFailed as failed:
        judged = CheckedProtocol(name, problem=with_helper(failed.problem, file, root, version))
    checked = dataclasses.replace(
        judged,
        file=name,
        lines=lines,
        seconds=time.monotonic() - start,
        declared=declared,
        off=tuple(rule.id for rule in rule_set.rules if options.severity_of(rule) == "off"),
        modules={module: around.modules[module].path for module in judged.modules},
    )
    notes = [f"rehearsed with opentrons {version}."] if version else []
    return _settle(_with_notes(checked, [*notes, *reaches(text)]), said, settings, around)


def _check_document(
    file: Path, settings: CheckSettings, rule_set: RuleSet, rehearser: LazyRehearser
) -> CheckedProtocol:
    how = (settings.options, settings.timeout_s, settings.robot_version)
    try:
        checked = check_document(file, *how, rule_set, rehearser)
    except TaskFailed as failed:
        return CheckedProtocol(file.as_posix(), problem=failed.problem)
    except AegisError as error:
        return CheckedProtocol(file.as_posix(), problem=Problem(str(error)))
    off = tuple(rule.id for rule in rule_set.rules if settings.options.severity_of(rule) == "off")
    if settings.asking is not None:
        checked = _with_notes(checked, ["no model was asked: there is no source to read."])
    return _settle(
        dataclasses.replace(checked, off=off), GuardArguments(), settings, Surroundings({}, {})
    )


def _judge_in(
    root: Path,
    around: Surroundings,
    settings: CheckSettings,
    rehearser: Rehearser,
    script: Script,
    options: Options,
    rule_set: RuleSet,
) -> CheckedProtocol:
    """Judge; where custom labware lacks, with the definitions of the same repository."""
    try:
        return _judge(rehearser, script, options, settings, rule_set)
    except TaskFailed as failed:
        if not lacks_labware(failed.problem):
            raise
        texts = [script.text, *around.texts.values()]
        place = Path(getattr(script, "folder", "")) / script.file_name
        found = named_in(place, texts, settings.definitions(root))
        if not found:
            raise
    labware = {**{one.uri: one.content for one in found}, **script.extra_labware}
    script = dataclasses.replace(script, extra_labware=labware)
    judged = _judge(rehearser, script, options, settings, rule_set)
    notes = [
        f"the labware {one.load_name} is defined by {os.path.relpath(one.file, place.parent)}, "
        "of the same repository."
        for one in found
    ]
    return _with_notes(judged, notes)


def _with_notes(checked: CheckedProtocol, notes: Sequence[str]) -> CheckedProtocol:
    report = checked.report
    if report is None or not notes:
        return checked
    noted = dataclasses.replace(report, notes=(*report.notes, *notes))
    return dataclasses.replace(checked, report=noted)


def _with_own_values(
    rehearser: Rehearser, script: Script, timeout_s: float
) -> tuple[Script, tuple[str, ...] | None]:
    """The script with those of the given values that are for its parameters, and their names.

    A value that another protocol of the call takes is none of this one's concern.
    """
    if not (script.parameters or script.csv_parameters):
        return script, None
    try:
        found = rehearser.perform(Describe(script, timeout_s))
    except TaskFailed:  # so will the rehearsal, and says why
        return script, None
    names = tuple(parameter.name for parameter in found)
    own = dataclasses.replace(
        script,
        parameters={n: value for n, value in script.parameters.items() if n in names},
        csv_parameters={n: path for n, path in script.csv_parameters.items() if n in names},
    )
    return own, names


def _judge(
    rehearser: Rehearser,
    script: Script,
    options: Options,
    settings: CheckSettings,
    rule_set: RuleSet,
) -> CheckedProtocol:
    """Rehearse and judge, with other parameters and with a model where that is asked for."""
    how = (script, options, settings.rules, settings.timeout_s)
    asked = CheckTask(*how, settings.playback, for_model=settings.asking is not None)
    examined: Examined = rehearser.perform(asked)
    report = examined.report
    exploration = judgement = dossier = None
    if settings.all_parameters:
        report, exploration = explore(rehearser, *how, report)
    if settings.asking is not None and examined.for_model is not None:
        dossier, recording = examined.for_model
        judgement = ask_model(settings.asking, report, dossier, recording, rule_set, options)
        report = judgement.report
    return CheckedProtocol(
        script.file_name,
        report=report,
        exploration=exploration,
        judgement=judgement,
        dossier=dossier,
        modules=dict.fromkeys(examined.modules, ""),
        playback=examined.playback,
        rehearsal_s=examined.rehearsal_s,
        verdict_s=examined.verdict_s,
    )


def options_for(arguments: GuardArguments, options: Options) -> Options:
    """What the command line leaves open, the guard inside the protocol may say."""
    said = Options.from_settings(Settings(**arguments.values))
    return dataclasses.replace(
        options,
        assay=options.assay or said.assay,
        roles={**said.roles, **options.roles},
        select=options.select or said.select,
        ignore=(*options.ignore, *said.ignore),
        strict=options.strict or said.strict,
    )


def _settle(
    checked: CheckedProtocol, said: GuardArguments, settings: CheckSettings, around: Surroundings
) -> CheckedProtocol:
    """Apply what the project has waived or put off; tell what of the guard was not read, and what
    was found around the protocol."""
    report = checked.report
    if report is None:
        return checked
    standing, waived = waive(checked.file, report, settings.waivers, settings.waiver_root)
    known: list[Finding] = []
    remarks = [*said.unread, *(around.modules[name].told(name) for name in checked.modules)]
    if settings.baseline is not None:
        standing, known, gone = settings.baseline.split(checked.file, standing, checked.lines)
        if gone:
            told = "a finding that no longer occurs"
            if gone > 1:
                told = f"{gone} findings that no longer occur"
            remarks.append(Remark(f"The baseline lists {told} here; write it anew."))
    return dataclasses.replace(
        checked,
        report=with_findings(report, standing, waived=(*report.waived, *waived)),
        baselined=tuple(known),
        settled=tuple(remarks),
    )
