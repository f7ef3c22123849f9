"""``aegis-ot check --fix``: writes what mends a protocol, and says what is left to its author."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path

import typer

from ..errors import AegisError, ConfigurationError
from ..workbench import CheckedProtocol, CheckRun, Project, check_projects
from ..workbench.files import read_protocol
from ..workbench.fixing import Fixed, fix
from ..workbench.side_by_side import RehearserPool
from .plain_text import plain

_BOM = b"\xef\xbb\xbf"


def fix_all(run: CheckRun, projects: Sequence[Project]) -> CheckRun:
    """Mend every protocol of a run that can be mended; the run as it stands afterwards.

    Raises:
        ConfigurationError: A file cannot be written, or was changed meanwhile.
    """
    by_file = {path.as_posix(): (path, project) for project in projects for path in project.files}
    pool = RehearserPool()
    try:
        protocols = [_fixed(checked, *by_file[checked.file], pool) for checked in run.protocols]
    finally:
        pool.close()
    return dataclasses.replace(run, protocols=tuple(protocols))


def _fixed(
    checked: CheckedProtocol, path: Path, project: Project, pool: RehearserPool
) -> CheckedProtocol:
    is_python = path.suffix.lower() == ".py"  # a document of commands is written by a program
    if not is_python or checked.report is None:
        return checked
    try:
        text = read_protocol(path)
    except AegisError:  # it is told of already
        return checked

    def judge(mended: str) -> CheckedProtocol:
        settings = dataclasses.replace(project.settings, texts={path: mended}, pool=pool, jobs=1)
        (again,) = check_projects([Project([path], settings, project.rule_set)], [path]).protocols
        return again

    fixed = fix(text, checked, judge)
    if fixed.done:
        _write(path, text, fixed.text)
    _say(checked.file, fixed)
    return fixed.checked


def _write(path: Path, before: str, after: str) -> None:
    try:
        data = path.read_bytes()
        mark = _BOM if data.startswith(_BOM) else b""
        if data != mark + before.encode():
            raise ConfigurationError(f"{path} was changed meanwhile; nothing is written to it.")
        path.write_bytes(mark + after.encode())
    except OSError as error:
        raise ConfigurationError(f"{path} cannot be written: {error.strerror}.") from None


def _say(file: str, fixed: Fixed) -> None:
    lines = [f"{file}: mended: {mend.title} ({', '.join(mend.rules)})" for mend in fixed.done]
    lines += [f"{file}: left to you: {mend.title} ({', '.join(mend.rules)})" for mend in fixed.left]
    for line in lines:
        typer.echo(plain(line), err=True)
