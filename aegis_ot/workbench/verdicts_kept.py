"""Verdicts that need not be worked out twice: of protocols that depend on their text alone.

Kept in the memory of a rehearsing process, beside what it was told to do, word for word, and the
state of every file that the rehearsal opened or looked for. A protocol that could ask anything else
(the clock, chance, the environment, a module around it) is rehearsed each time.
"""

from __future__ import annotations

import ast
import hashlib
import pickle
from collections.abc import Mapping
from typing import Any, NamedTuple

from .files_read import Signature, unchanged

_MOST = 200

_PURE = frozenset(
    {
        "__future__", "abc", "aegis_ot", "bisect", "collections", "copy", "csv", "dataclasses",
        "decimal", "enum", "fractions", "functools", "heapq", "io", "itertools", "json", "math",
        "opentrons", "operator", "re", "statistics", "string", "textwrap", "typing",
    }
)  # fmt: skip
"""Modules whose functions give the same for the same arguments."""

_ASKING = frozenset(
    {
        "open", "exec", "eval", "compile", "__import__", "input", "globals", "locals", "vars", "id",
        "hash", "os", "sys", "time", "random", "getattr", "breakpoint", "__builtins__", "__dict__",
        "__globals__", "__subclasses__", "__loader__", "__spec__", "modules", "config", "object",
    }
)  # fmt: skip
"""Names that lead beyond the text, as variables or as attributes."""


class Kept(NamedTuple):
    """An answer as it was sent, and the files that it rests on."""

    answer: bytes
    files: Mapping[str, Signature]


class KeptVerdicts:
    """The last answers, by what was asked."""

    def __init__(self) -> None:
        self._kept: dict[str, Kept] = {}

    def find(self, key: str) -> bytes | None:
        """The answer, if every file that it rests on stands as it did."""
        kept = self._kept.get(key)
        return kept.answer if kept is not None and unchanged(kept.files) else None

    def add(self, key: str, kept: Kept) -> None:
        """Keep one more; the oldest goes."""
        self._kept.pop(key, None)
        self._kept[key] = kept
        if len(self._kept) > _MOST:
            del self._kept[next(iter(self._kept))]


def key_of(task: Any) -> str:
    """What is asked, word for word, as a key; ``""`` where the answer may be another next time."""
    script = getattr(task, "script", None)
    text = getattr(script, "text", "")
    if not text or getattr(script, "modules", None) or not _is_self_contained(text):
        return ""
    return hashlib.sha256(pickle.dumps(task)).hexdigest()


def _is_self_contained(text: str) -> bool:
    try:
        nodes = list(ast.walk(ast.parse(text)))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return all(map(_is_plain, nodes))


def _is_plain(node: ast.AST) -> bool:
    if isinstance(node, ast.Import):
        return all(_is_pure(alias.name) for alias in node.names)
    if isinstance(node, ast.ImportFrom):
        named = {alias.name for alias in node.names}
        return node.level == 0 and _is_pure(node.module or "") and not named & _ASKING
    if isinstance(node, ast.Name):
        return node.id not in _ASKING
    return not isinstance(node, ast.Attribute) or node.attr not in _ASKING


def _is_pure(module: str) -> bool:
    return module.partition(".")[0] in _PURE and not set(module.split(".")) & _ASKING
