"""Where a protocol reaches beyond the robot: mail, network, files, other programs.

A rehearsal does all that as well. What stands under ``if not protocol.is_simulating():`` is left
out by it, and not told.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

_MODULES: Mapping[str, str] = {
    "smtplib": "sends mail",
    "socket": "opens a network connection",
    "requests": "opens a network connection",
    "urllib.request": "opens a network connection",
    "http.client": "opens a network connection",
    "paramiko": "opens a network connection",
    "shutil": "changes files",
    "subprocess": "starts another program",
    "os.system": "starts another program",
    "os.popen": "starts another program",
    **{f"os.{name}": "changes files" for name in ("remove", "rename", "mkdir", "makedirs")},
}
_METHODS = frozenset({"write_text", "write_bytes", "to_csv", "to_excel", "unlink"})
_WRITING, _MODE = frozenset("wax+"), frozenset("rwaxbt+U")
_ASKING = "is_simulating"


def reaches(text: str) -> list[str]:
    """What a protocol does beyond the robot, each kind in a sentence with its first line."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    imported: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                first = alias.name.partition(".")[0]
                imported[alias.asname or first] = alias.name if alias.asname else first
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                imported[alias.asname or alias.name] = f"{node.module or ''}.{alias.name}"
    lines: dict[str, int] = {}
    for call in _calls(tree):
        done = _done_by(call, imported)
        if done:
            lines[done] = min(call.lineno, lines.get(done, call.lineno))
    return [
        f"line {line}: it {done}, and so does every rehearsal; a run with the guard executes the "
        "protocol twice. Under `if not protocol.is_simulating():` it happens in the run alone."
        for done, line in sorted(lines.items(), key=lambda item: item[1])
    ]


def _calls(tree: ast.AST) -> Iterator[ast.Call]:
    """Every call that a rehearsal may make."""
    open_ = [tree]
    while open_:
        node = open_.pop()
        if isinstance(node, ast.If) and _ASKING in ast.dump(node.test):
            is_not = isinstance(node.test, ast.UnaryOp) and isinstance(node.test.op, ast.Not)
            open_ += node.orelse if is_not else node.body
            continue
        if isinstance(node, ast.Call):
            yield node
        open_ += ast.iter_child_nodes(node)


def _done_by(call: ast.Call, imported: Mapping[str, str]) -> str:
    """What a call does beyond the robot, or ``""``."""
    name = ast.unparse(call.func) if isinstance(call.func, (ast.Name, ast.Attribute)) else ""
    first, dot, rest = name.partition(".")
    full = f"{imported.get(first, '')}{dot}{rest}" if first in imported else ""
    for module, done in _MODULES.items():
        if full == module or full.startswith(f"{module}."):
            return f"{done} ({full})"
    method = call.func.attr if isinstance(call.func, ast.Attribute) else ""
    if method in _METHODS:
        return "writes a file"
    if "open" in (name, method):
        place = 1 if name == "open" else 0
        given = [
            *call.args[place : place + 1],
            *(k.value for k in call.keywords if k.arg == "mode"),
        ]
        modes = [one.value for one in given if isinstance(one, ast.Constant)]
        if any(isinstance(mode, str) and _WRITING & {*mode} and {*mode} <= _MODE for mode in modes):
            return "writes a file"
    return ""
