"""Checks the protocols of several projects in one call: each by its own settings, told together."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from .. import __version__
from ..adapters.opentrons.rehearsal import undeclared
from ..preflight import RuleSet
from .result import CheckedProtocol, CheckRun, Problem
from .run import CheckSettings, check_alike


class Project(NamedTuple):
    """Protocols that are checked alike.

    Attributes:
        files: The protocol files.
        settings: How to check them.
        rule_set: The rules in force, with ``settings.rules``.
    """

    files: Sequence[Path]
    settings: CheckSettings
    rule_set: RuleSet


def check_projects(
    projects: Sequence[Project],
    files: Sequence[Path],
    done: Callable[[CheckedProtocol], None] = lambda checked: None,
) -> CheckRun:
    """Check the protocols of all projects.

    Each takes those of the given runtime parameters that it declares. What none of them declares
    keeps them from being judged.

    Args:
        projects: At least one.
        files: All their files, each once, in the order to tell of them.
        done: Told of each file when it is done, project after project.

    Raises:
        RehearsalError: The rehearsing process cannot be started.
    """
    checked = {
        protocol.file: protocol for project in projects for protocol in check_alike(*project, done)
    }
    settings = projects[0].settings
    given = (*settings.parameters, *settings.csv_parameters)
    return CheckRun(
        tuple(_refused_unknown([checked[file.as_posix()] for file in files], given)),
        _together(project.rule_set for project in projects),
        __version__,
        settings.explain_roles,
    )


def check_files(
    files: Sequence[Path],
    settings: CheckSettings,
    rule_set: RuleSet,
    done: Callable[[CheckedProtocol], None] = lambda checked: None,
) -> CheckRun:
    """Check protocol files that are one project's; see :func:`check_projects`."""
    return check_projects([Project(files, settings, rule_set)], files, done)


def _refused_unknown(
    protocols: Sequence[CheckedProtocol], given: Sequence[str]
) -> Iterable[CheckedProtocol]:
    """None is judged with a value that went unheard: for a parameter that none of them declares."""
    declared = [checked.declared for checked in protocols]
    heard = {name for names in declared for name in names or ()}
    unknown = [name for name in given if name not in heard]
    if None in declared:  # it cannot be judged either, and might declare them
        unknown = []
    for checked, names in zip(protocols, declared, strict=True):
        if unknown and names is not None:  # a file under another name is lacking elsewhere
            problem = Problem(undeclared(unknown, names))
            yield CheckedProtocol(checked.file, problem=problem, lines=checked.lines)
        else:
            yield checked


def _together(databases: Iterable[RuleSet]) -> RuleSet:
    """Every rule of all of them, for the reports to name; each identifier once."""
    first, *others = databases
    families = list(first.families)
    known = {rule.id for rule in first.rules}
    for rule_set in others:
        for family in rule_set.families:
            new = tuple(rule for rule in family.rules if rule.id not in known)
            if new:
                families.append(dataclasses.replace(family, rules=new))
                known.update(rule.id for rule in new)
    return dataclasses.replace(first, families=tuple(families))
