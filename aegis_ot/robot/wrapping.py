"""A protocol with the guard inside: one file, for robots on which nothing may be installed."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ..errors import ConfigurationError
from .bundle import ROOT, Bundle, make_bundle

_COMPOUND = (
    ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.If, ast.For, ast.AsyncFor, ast.While,
    ast.With, ast.AsyncWith, ast.Try, ast.Match,
)  # fmt: skip
_FIRST_LINES = re.compile(r"^#!|coding[:=]")


@dataclass(frozen=True)
class Wrapped:
    """A protocol that carries its guard.

    Attributes:
        text: Its source.
        moved: By how many lines the original's lines moved down; 0 but for a protocol that begins
            with a definition in its very first line.
        guarded_before: Whether the original called the guard itself.
        bundle: What was put in.
    """

    text: str
    moved: int
    guarded_before: bool
    bundle: Bundle


def wrap(
    text: str, settings: Mapping[str, Any] | None = None, bundle: Bundle | None = None
) -> Wrapped:
    """Put the guard into a protocol. The original's statements keep their lines.

    Args:
        text: The protocol.
        settings: Of the guard, as keyword arguments; only where the protocol does not call it.
        bundle: Instead of this package's own robot half.

    Raises:
        ConfigurationError: It is no Python, has no ``run``, or carries a guard with settings of
            its own while others are given.
    """
    try:
        tree = ast.parse(text)
    except SyntaxError as error:
        why = f"line {error.lineno}: {error.msg}"
        raise ConfigurationError(f"The protocol is no Python: {why}.") from None
    except ValueError as error:
        raise ConfigurationError(f"The protocol is no Python: {error}.") from None
    if not any(isinstance(node, ast.FunctionDef) and node.name == "run" for node in tree.body):
        raise ConfigurationError("The protocol defines no function run at its top level.")
    bundle = bundle or make_bundle(also=sorted(_modules_beside_the_guard(tree)))
    lines = text.splitlines(keepends=True)
    guarded = _rename_imports(tree, lines, bundle.name)
    if guarded and settings:
        raise ConfigurationError(
            "The protocol calls the guard itself. Write the settings there, as in "
            '@guard(assay="pcr").'
        )
    moved = _put_in(tree, lines, bundle.statement)
    if not guarded:
        if lines and not lines[-1].endswith("\n"):
            lines[-1] += "\n"
        given = "".join(f", {name}={value!r}" for name, value in (settings or {}).items())
        lines.append(f"run = __import__({bundle.name!r}).guard(run{given})\n")
    return Wrapped("".join(lines), moved, guarded, bundle)


def _modules_beside_the_guard(tree: ast.AST) -> set[str]:
    """Modules of this package that a protocol imports by name."""
    froms = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    names = [node.module or "" for node in froms if node.level == 0]
    return {name for name in names if name.startswith(f"{ROOT}.")}


def _rename_imports(tree: ast.AST, lines: list[str], name: str) -> bool:
    """Let the protocol's own imports of the guard find the bundle; whether there are any."""
    found: list[tuple[int, int, str]] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level == 0:
            if (node.module or "").partition(".")[0] == ROOT:
                found.append((node.lineno, node.col_offset, name))
        elif isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name == ROOT:
                    new = name if alias.asname else f"{name} as {ROOT}"
                    found.append((alias.lineno, alias.col_offset, new))
    for line, offset, new in sorted(found, reverse=True):
        raw = lines[line - 1].encode()
        head, tail = raw[:offset].decode(), raw[offset:].decode()
        lines[line - 1] = head + re.sub(rf"\b{ROOT}\b", new, tail, count=1)
    return bool(found)


def _put_in(tree: ast.Module, lines: list[str], statement: str) -> int:
    """Put a statement before all others without moving them; by how many lines it did."""
    body = tree.body
    before = 1 if body and isinstance(body[0], ast.Expr) and _is_text(body[0].value) else 0
    while isinstance(body[before], ast.ImportFrom) and _module_of(body[before]) == "__future__":
        before += 1
    first = body[before]
    begins = min([first.lineno, *(d.lineno for d in getattr(first, "decorator_list", ()))])
    after = body[before - 1].end_lineno or 0 if before else 0
    for number in range(after + 1, begins):
        line = lines[number - 1]
        free = not line.strip() or line.lstrip().startswith("#")
        if free and not (number <= 2 and _FIRST_LINES.search(line)):
            comment = f"  {line.strip()}" if line.strip() else ""
            lines[number - 1] = f"{statement}{comment}\n"
            return 0
    if not isinstance(first, _COMPOUND):
        lines[begins - 1] = f"{statement}; {lines[begins - 1]}"
        return 0
    if before:
        raw, end = lines[after - 1].encode(), body[before - 1].end_col_offset or 0
        lines[after - 1] = f"{raw[:end].decode()}; {statement}{raw[end:].decode()}"
        return 0
    lines.insert(begins - 1, f"{statement}\n")
    return 1


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _module_of(node: ast.AST) -> str:
    return getattr(node, "module", "") or ""
