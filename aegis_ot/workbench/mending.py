"""Edits that mend a protocol: a fresh tip, an offered role, a waiver.

An edit is offered from what a report says and where the text says it. Whether it mends anything
only another check tells: see :mod:`.fixing`.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ..preflight import Report
from ..vocabulary import Finding, Undecided

_LINE_END = re.compile(r"\r\n|\r|\n")
_IMPORT = "from aegis_ot import guard"
_FRESH = '"always"'
_SHARED = ("once",)


@dataclass(frozen=True)
class Edit:
    """One replacement in a text.

    Attributes:
        start, end: Offsets in characters; equal for an insertion.
        text: What stands there afterwards.
    """

    start: int
    end: int
    text: str


@dataclass(frozen=True)
class Mend:
    """One way to mend a protocol.

    Attributes:
        kind: ``"tip"``, ``"role"`` or ``"waiver"``.
        title: What it does, for people.
        rules: The rules that it is meant for.
        line: Where the trouble stands, 1-based; ``None`` for the protocol as a whole.
        edits: In the order of the text; none overlaps another.
        sure: Whether it says nothing that only the author knows: a role that several wells might
            have, or why a rule is waived, is theirs to say.
    """

    kind: str
    title: str
    rules: tuple[str, ...]
    line: int | None
    edits: tuple[Edit, ...]
    sure: bool


def applied(text: str, edits: Sequence[Edit]) -> str:
    """The text with these edits."""
    for edit in sorted(edits, key=lambda edit: edit.start, reverse=True):
        text = text[: edit.start] + edit.text + text[edit.end :]
    return text


def mends_of(text: str, report: Report) -> list[Mend]:
    """Every edit that might mend what a report says of this text; none where it does not parse."""
    try:
        source = _Source(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    found: dict[tuple[Edit, ...], Mend] = {}
    offered = [mend for undecided in report.undecided for mend in _offered(source, undecided)]
    for finding in report.findings:
        offered += [*_fresh_tips(source, finding), *_waivers(source, finding)]
    for mend in offered:
        known = found.get(mend.edits, mend)
        rules = tuple(dict.fromkeys((*known.rules, *mend.rules)))
        found[mend.edits] = replace(known, rules=rules)
    return list(found.values())


class _Source:
    """A protocol's text, and where its parts stand."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tree = ast.parse(text)
        ends = list(_LINE_END.finditer(text))
        self.starts = [0, *(match.end() for match in ends)]
        self.newline = ends[0][0] if ends else "\n"

    def offset(self, line: int, column: int) -> int:
        """Of a place as :mod:`ast` tells it: a 1-based line, a column in bytes."""
        start = self.starts[line - 1]
        stop = self.starts[line] if line < len(self.starts) else len(self.text)
        return start + len(self.text[start:stop].encode()[:column].decode(errors="ignore"))

    def span(self, node: ast.expr | ast.keyword) -> tuple[int, int]:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return (
            self.offset(node.lineno, node.col_offset),
            self.offset(node.end_lineno, node.end_col_offset),
        )

    def above(self, node: ast.stmt, text: str) -> Edit:
        """A line of its own above a statement, or above its decorators."""
        lines = [node.lineno, *(d.lineno for d in getattr(node, "decorator_list", ()))]
        start = self.starts[min(lines) - 1]
        indent = re.match(r"[ \t]*", self.text[start:])
        return Edit(start, start, f"{indent[0] if indent else ''}{text}{self.newline}")

    def statement_at(self, line: int) -> ast.stmt | None:
        """The innermost statement at a line."""
        inner = [
            node
            for node in ast.walk(self.tree)
            if isinstance(node, ast.stmt) and node.lineno <= line <= (node.end_lineno or 0)
        ]
        return max(inner, key=lambda node: (node.lineno, node.col_offset), default=None)


def _fresh_tips(source: _Source, finding: Finding) -> Iterator[Mend]:
    """``new_tip="once"`` of a call that a finding names."""
    for call in (node for node in ast.walk(source.tree) if isinstance(node, ast.Call)):
        if not any(call.lineno <= line <= (call.end_lineno or 0) for line in finding.lines):
            continue
        for keyword in call.keywords:
            value = keyword.value
            if keyword.arg == "new_tip" and isinstance(value, ast.Constant):
                if str(value.value).lower() not in _SHARED:
                    continue
                edit = Edit(*source.span(value), _FRESH)
                title = 'Take a fresh tip for each transfer (new_tip="always")'
                yield Mend("tip", title, (finding.rule,), call.lineno, (edit,), True)


def _waivers(source: _Source, finding: Finding) -> Iterator[Mend]:
    """A waiver above the statement where the harm was done; its reason is the author's to write."""
    line = finding.lines[-1] if finding.lines else None
    statement = source.statement_at(line) if line else None
    if statement is not None:
        edit = source.above(statement, f"# aegis: ignore[{finding.rule}] ")
        title = f"Waive {finding.rule} here (write the reason behind it)"
        yield Mend("waiver", title, (finding.rule,), line, (edit,), False)


def _offered(source: _Source, undecided: Undecided) -> Iterator[Mend]:
    """The guard's argument that a rule asks for, put into the protocol's guard."""
    try:
        offered = ast.parse(undecided.paste.lstrip("@"), mode="eval").body
    except SyntaxError:
        return
    run = next((n for n in source.tree.body if _is_run(n)), None)
    if not isinstance(offered, ast.Call) or not isinstance(run, ast.FunctionDef):
        return
    given = {one.arg: ast.literal_eval(one.value) for one in offered.keywords if one.arg}
    if any("..." in place for places in given.get("roles", {}).values() for place in places):
        return  # concentrations, which only the author knows
    edits = _with_arguments(source, run, given)
    if edits is None:
        return
    roles: Mapping[str, Sequence[str]] = given.get("roles", {})
    named = [place for places in roles.values() for place in places]
    alone = len(roles) == 1 and len(named) == 1 and re.fullmatch(r"[^,\-]+:[A-Z]+\d+", named[0])
    told = ", ".join(f"{role}: {', '.join(places)}" for role, places in roles.items())
    title = f"Give the guard {told or undecided.paste} ({undecided.to_write})"
    yield Mend("role", title, (undecided.rule,), run.lineno, tuple(edits), bool(alone))


def _is_run(node: ast.stmt) -> bool:
    return isinstance(node, ast.FunctionDef) and node.name == "run"


def _with_arguments(
    source: _Source, run: ast.FunctionDef, given: Mapping[str, object]
) -> list[Edit] | None:
    """The edits that give a protocol's guard these arguments; ``None`` where it has them already,
    or says them in a way that cannot be added to."""
    guards = [d for d in run.decorator_list if _named(d) == "guard"]
    written = ", ".join(f"{name}={_literal(value)}" for name, value in given.items())
    if not guards:
        if run.decorator_list or "guard" in {_named(n) for n in ast.walk(source.tree)}:
            return None
        return [*_import(source), source.above(run, f"@guard({written})")]
    guard = guards[0]
    if not isinstance(guard, ast.Call):
        _, end = source.span(guard)
        return [Edit(end, end, f"({written})")]
    edits: list[Edit] = []
    for name, value in given.items():
        known = next((one for one in guard.keywords if one.arg == name), None)
        if known is None:
            _, end = source.span(guard)
            last = source.text[: end - 1].rstrip()
            comma = "" if last.endswith(("(", ",")) else ", "
            edits.append(Edit(end - 1, end - 1, f"{comma}{name}={_literal(value)}"))
        elif isinstance(known.value, ast.Dict) and isinstance(value, dict):
            had = {ast.literal_eval(key) for key in known.value.keys if key is not None}
            if had & set(value):
                return None
            start, _ = source.span(known.value)
            inner = _literal(value)[1:-1] + (", " if had else "")
            edits.append(Edit(start + 1, start + 1, inner))
        else:
            return None
    return edits


def _import(source: _Source) -> list[Edit]:
    """``from aegis_ot import guard`` above the first import that is not of the future."""
    for node in source.tree.body:
        is_future = isinstance(node, ast.ImportFrom) and node.module == "__future__"
        is_text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        if not is_future and not is_text:
            return [source.above(node, _IMPORT)]
    return []


def _named(node: ast.AST) -> str:
    """``guard`` for ``@guard``, ``@guard(...)`` and ``@aegis_ot.guard(...)``."""
    if isinstance(node, ast.Call):
        node = node.func
    if isinstance(node, ast.Attribute):
        module = node.value
        return node.attr if isinstance(module, ast.Name) and module.id == "aegis_ot" else ""
    return node.id if isinstance(node, ast.Name) else ""


def _literal(value: object) -> str:
    # Texts and lists of texts in JSON are such as Python writes them as well.
    return json.dumps(value, ensure_ascii=False)
