"""``aegis_ot.check``: Layer 1 from Python, for notebooks, editors, agents and scripts."""

from __future__ import annotations

import atexit
import dataclasses
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError, RehearsalError
from ..preflight import Report
from .baseline import read_baseline
from .call_settings import settings_of
from .configuration import configurations_of
from .projects import Project, check_projects
from .result import CheckedProtocol
from .side_by_side import RehearserPool

_UNNAMED = "protocol.py"
"""The file that a bare text stands for, in the working folder."""

Source = str | os.PathLike[str]

_POOL = RehearserPool()
"""The second check in a notebook need not load Opentrons again."""
atexit.register(_POOL.close)


def check(
    source: Source,
    *,
    file: Source | None = None,
    assay: str | Sequence[str] = (),
    roles: Mapping[str, Sequence[str]] | None = None,
    select: Sequence[str] = (),
    ignore: Sequence[str] = (),
    strict: bool = False,
    rules: Sequence[Source] = (),
    labware: Sequence[Source] = (),
    parameters: Mapping[str, Any] | None = None,
    csv: Mapping[str, Source] | None = None,
    timeout: float | None = None,
) -> Report:
    """Rehearse a protocol and judge it by the rules, as ``aegis-ot check`` does.

    The rehearsal runs in a process of its own. What is left out here, the protocol's guard and the
    project's ``pyproject.toml`` say. No model is asked.

    Args:
        source: The path of a Python protocol, or its text (a ``str`` with a line break).
        file: Of a text: the file that it belongs to, for what lies around it.
        assay: Assay family or families; inferred if left out.
        roles: Places by role, as for the guard: ``{"ntc": ["1:H12"]}``.
        select: Only these rules.
        ignore: Not these rules.
        strict: Whether warnings are errors.
        rules: Files or folders of further rules.
        labware: Files or folders with custom labware definitions.
        parameters: Values of runtime parameters, by name.
        csv: Files of CSV runtime parameters, by name.
        timeout: Longest rehearsal, s; 120 if left out.

    Returns:
        The verdict with its findings, undecided rules and remarks.

    Raises:
        RehearsalError: The protocol cannot be judged; ``line`` says where it stopped.
        ConfigurationError: An argument, or the project's configuration, cannot be used.
        RuleError: A rule file cannot be used.
    """
    given = {
        "assay": [assay] if isinstance(assay, str) else list(assay),
        "select": list(select),
        "ignore": list(ignore),
        "strict": strict,
        "rules": [Path(place) for place in rules],
        "labware": [Path(place) for place in labware],
        "timeout": timeout,
    }
    checked = checked_protocol(source, file, given, roles or {}, parameters or {}, csv or {})
    return report_of(checked)


def report_of(checked: CheckedProtocol) -> Report:
    """What was found.

    Raises:
        RehearsalError: It could not be judged; ``line`` says where it stopped.
    """
    if checked.report is None:
        problem = checked.problem
        where = f"{checked.file}:{problem.line}" if problem and problem.line else checked.file
        told = problem.message if problem else "could not be judged."
        raise RehearsalError(f"{where}: {told}", problem.line if problem else None)
    return checked.report


def checked_protocol(
    source: Source,
    file: Source | None = None,
    given: Mapping[str, Any] | None = None,
    roles: Mapping[str, Sequence[str]] | None = None,
    parameters: Mapping[str, Any] | None = None,
    csv: Mapping[str, Source] | None = None,
) -> CheckedProtocol:
    """As :func:`check`, with why it could not be judged as a value; ``given`` as for settings."""
    is_text = isinstance(source, str) and ("\n" in source or file is not None)
    if file is not None and not is_text:
        raise ConfigurationError("file: is for a text; a path says itself which file it is.")
    path = Path(file or _UNNAMED) if is_text else Path(source)
    ((configured, _),) = configurations_of([path], Path.cwd())
    settings, rule_set = settings_of(configured, **(given or {}))
    known = configured.baseline
    settings = dataclasses.replace(
        settings,
        options=dataclasses.replace(settings.options, roles=roles or {}),
        parameters=dict(parameters or {}),
        csv_parameters={name: Path(place).resolve() for name, place in (csv or {}).items()},
        pool=_POOL,
        texts={path: str(source)} if is_text else {},
        baseline=read_baseline(Path(known)) if known else None,
    )
    run = check_projects([Project([path], settings, rule_set)], [path])
    return run.protocols[0]
