"""The robot half as one text: its modules, packed, with what unpacks them in memory.

For robots on which nothing may be installed. The package gets a name of its own, made from its
contents: two protocols wrapped by two versions, or one beside an installed ``aegis_ot``, do not
meet.
"""

from __future__ import annotations

import ast
import base64
import hashlib
import io
import json
import tokenize
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib.util import resolve_name
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent
ROOT = "aegis_ot"

# Line (from 1) and character (from 0).
_Place = tuple[int, int]

_LOADER = Path(__file__).with_name("bundle_loader.py")


@dataclass(frozen=True)
class Bundle:
    """The packed robot half.

    Attributes:
        name: Under which it is imported: ``aegis_ot_0123456789``.
        statement: One line of Python that makes ``import NAME`` work.
        modules: How many modules are in it.
    """

    name: str
    statement: str
    modules: int


def make_bundle(also: Iterable[str] = ()) -> Bundle:
    """Pack ``guard`` with all that it imports, the compiled rules among it."""
    files = {name: stripped(text) for name, text in sorted(robot_half(PACKAGE, also))}
    modules = len(files)
    data = json.dumps(files, ensure_ascii=False, separators=(",", ":")).encode()
    name = f"{ROOT}_{hashlib.sha256(data).hexdigest()[:10]}"
    loader = stripped(_LOADER.read_text(encoding="utf-8")) + "install(NAME, PAYLOAD)\n"
    names = f"{{'NAME': {name!r}, 'PAYLOAD': '{_packed(data)}', '__name__': {name + '.loader'!r}}}"
    statement = (
        f"{name!r} in __import__('sys').modules or exec(__import__('zlib').decompress("
        f"__import__('base64').b85decode('{_packed(loader.encode())}')), {names})"
    )
    return Bundle(name, statement, modules)


def _packed(data: bytes) -> str:
    # Its letters need no escape in a literal of Python.
    return base64.b85encode(zlib.compress(data, 9)).decode()


def robot_half(package: Path, also: Iterable[str] = ()) -> Iterator[tuple[str, str]]:
    """Path in the package and source of every module that ``guard``, or one of ``also``, can come
    to import."""
    todo, seen = [ROOT, *also], set()
    while todo:
        module = todo.pop()
        path = _path_of(package, module)
        if module in seen or path is None:
            continue
        seen.add(module)
        text = path.read_text(encoding="utf-8")
        yield path.relative_to(package).as_posix(), text
        around = module if path.name == "__init__.py" else module.rpartition(".")[0]
        tree = ast.parse(text)
        if module == ROOT:
            # What its door opens later is `check`, which stays on the workstation.
            tree.body = [node for node in tree.body if not isinstance(node, ast.If)]
        todo += [around, *_imported(tree, around)]


def _imported(tree: ast.AST, around: str) -> Iterable[str]:
    """Modules of this package that a module imports, at any depth, and their packages."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            base = resolve_name("." * node.level + (node.module or ""), around)
            names = [base, *(f"{base}.{alias.name}" for alias in node.names)]
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        else:
            continue
        for name in names:
            parts = name.split(".")
            if parts[0] == ROOT:
                yield from (".".join(parts[:n]) for n in range(1, len(parts) + 1))


def _path_of(package: Path, module: str) -> Path | None:
    inner = package.joinpath(*module.split(".")[1:])
    for path in (inner / "__init__.py", inner.with_suffix(".py")):
        if path.is_file():
            return path
    return None


def stripped(text: str) -> str:
    """Without comments, docstrings and what a function says of its types; every statement stays
    on its line."""
    lines = text.splitlines()
    blank: list[tuple[_Place, _Place, str]] = []
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            blank.append((token.start, token.end, ""))
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            first = node.body[0] if node.body else None
            if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
                # Not nothing: a dataclass without a docstring writes one, which takes time.
                blank.append((_start(lines, first), _end(lines, first), "'.'"))
        if isinstance(node, ast.arg) and node.annotation:
            line, left = _start(lines, node)
            blank.append(((line, left + len(node.arg)), _end(lines, node.annotation), ""))
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and node.returns:
            line, left = _start(lines, node.returns)
            arrow = lines[line - 1].rindex("->", 0, left)
            blank.append(((line, arrow), _end(lines, node.returns), ""))
    for (begins, left), (ends, right), instead in sorted(blank, reverse=True):
        tail = lines[ends - 1][right:]
        lines[begins - 1] = lines[begins - 1][:left] + instead + tail
        lines[begins:ends] = [""] * (ends - begins)
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _start(lines: list[str], node: ast.expr | ast.stmt | ast.arg) -> _Place:
    return node.lineno, _characters(lines, node.lineno, node.col_offset)


def _end(lines: list[str], node: ast.expr | ast.stmt) -> _Place:
    line = node.end_lineno or 0
    return line, _characters(lines, line, node.end_col_offset or 0)


def _characters(lines: list[str], line: int, offset: int) -> int:
    """From a place in bytes, as ``ast`` counts, to one in characters."""
    return len(lines[line - 1].encode()[:offset].decode())
