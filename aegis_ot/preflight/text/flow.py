"""Which names of a protocol take their values from which, and what loops run over.

``for (tube, conc), row in zip(BSA, "ABC")`` tells that ``tube`` and ``conc`` come from ``BSA``,
and, where that is a literal, which values each of them takes in turn.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import Any

from .facts import Loop, SourceFacts, Values
from .literals import fields_in, keying_names, names_in, plain_text
from .sequences import counted, sequence_of

_DRAWN = {
    "aspirate": (1, "location"),
    "transfer": (1, "source"),
    "distribute": (1, "source"),
    "consolidate": (1, "source"),
    "transfer_with_liquid_class": (2, "source"),
}
"""Where each liquid-moving call names its source: position and keyword."""

_ANYWHERE = (0, 1 << 30)

EVERYWHERE = range(1, 100_000)
"""All lines of a protocol."""


def read_flow(tree: ast.Module, facts: SourceFacts) -> None:
    """Note where names come from, loops over literals, and what each draw names."""
    parameters = {
        node.name: [argument.arg for argument in node.args.args]
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign):
            _assigned(facts, node.targets, node.value)
        elif isinstance(node, (ast.For, ast.AsyncFor)):
            span = (node.lineno, node.end_lineno or node.lineno)
            _loop(facts, node.target, node.iter, span, names_in(node.target))
        elif isinstance(node, (ast.ListComp, ast.SetComp, ast.GeneratorExp, ast.DictComp)):
            span = (node.lineno, node.end_lineno or node.lineno)
            for generator in node.generators:
                _loop(facts, generator.target, generator.iter, span, ())
        elif isinstance(node, ast.Call):
            if isinstance(node.func, ast.Name) and node.func.id in parameters:
                given = [*zip(parameters[node.func.id], node.args, strict=False)]
                given += _spread_out(facts, parameters[node.func.id], node.args)
                given += [(word.arg, word.value) for word in node.keywords if word.arg]
                for name, argument in given:
                    _comes(facts, name, argument, _ANYWHERE)
                    facts.called_at.setdefault(name, set()).add(node.lineno)
            elif isinstance(node.func, ast.Attribute) and node.func.attr in _DRAWN:
                _draw(facts, node, *_DRAWN[node.func.attr])


def origins(
    facts: SourceFacts, names: Iterable[str], lines: Collection[int], by_keys: bool = True
) -> set[str]:
    """These names and all that their values come from, in loops around one of these lines.

    Or around any call that gives a parameter among them its value, if no such call is one of them.
    Not ``by_keys``, where these only say which value it is.
    """
    found: set[str] = set()
    open_ = list(names)
    calls: set[int] = set()
    while open_:
        name = open_.pop()
        if name in found:
            continue
        found.add(name)
        called = facts.called_at.get(name, set())
        calls |= called if not any(line in lines for line in called) else set()
        keys = set() if by_keys else facts.keyed_by.get(name, set())
        for other, first, last in facts.comes_from.get(name, ()):
            around = _meets(lines, first, last) or _meets(calls, first, last)
            if around and other not in keys:
                open_.append(other)
    return found


def _meets(lines: Collection[int], first: int, last: int) -> bool:
    """Whether any of these lines is within a span; a range of them may be as long as can be."""
    if isinstance(lines, range):
        return lines.start <= last and first < lines.stop
    return any(first <= line <= last for line in lines)


def _spread_out(
    facts: SourceFacts, parameters: Sequence[str], arguments: Sequence[ast.expr]
) -> Iterator[tuple[str, ast.expr]]:
    """What a row gives to the parameters that it is spread over: ``give(*TREATMENTS[dose])``."""
    for at, argument in enumerate(arguments):
        if isinstance(argument, ast.Starred):
            taking = tuple(parameters[at:])
            facts.unpacked.append(taking)
            yield from ((name, argument.value) for name in taking)
            return


def _comes(facts: SourceFacts, name: str, value: ast.expr, span: tuple[int, int]) -> None:
    known = facts.comes_from.setdefault(name, set())
    named = (*names_in(value), *fields_in(value))
    known.update((other, *span) for other in named if other != name)
    facts.keyed_by.setdefault(name, set()).update(keying_names(value))
    for inner in ast.walk(value):
        if isinstance(inner, ast.Subscript) and plain_text(inner.slice):
            facts.asked.setdefault(name, set()).add((plain_text(inner.slice), *span))


def _assigned(facts: SourceFacts, targets: Iterable[ast.expr], value: ast.expr) -> None:
    for target in targets:
        _unpacks(facts, target)
        for part, given in _pairs(target, value):
            for name in names_in(part):
                _comes(facts, name, given, _ANYWHERE)
        if not isinstance(target, ast.Name):
            continue
        if not isinstance(value, (ast.ListComp, ast.GeneratorExp)) or len(value.generators) > 1:
            continue
        made = value.generators[0]
        if not made.ifs:
            _loop(facts, made.target, made.iter, _ANYWHERE, (target.id,))


def _pairs(target: ast.expr, value: ast.expr) -> Iterator[tuple[ast.expr, ast.expr]]:
    """What each part of a target is given: ``tube, well = row["tube"], row["well"]``."""
    if (
        isinstance(target, ast.Tuple)
        and isinstance(value, ast.Tuple)
        and len(target.elts) == len(value.elts)
    ):
        yield from zip(target.elts, value.elts, strict=True)
    else:
        yield target, value


def _unpacks(facts: SourceFacts, target: ast.expr) -> None:
    if isinstance(target, (ast.Tuple, ast.List)):
        names = tuple(part.id if isinstance(part, ast.Name) else "" for part in _leaves(target))
        if all(names):
            facts.unpacked.append(names)
        for part in target.elts:
            _unpacks(facts, part)  # "arm, (tube, column)": each row, and what is within it


def _leaves(target: ast.expr) -> Iterator[ast.expr]:
    if isinstance(target, (ast.Tuple, ast.List)):
        for part in target.elts:
            yield from _leaves(part)
    else:
        yield target


def _draw(facts: SourceFacts, call: ast.Call, position: int, keyword: str) -> None:
    given = call.args[position] if len(call.args) > position else None
    given = next((k.value for k in call.keywords if k.arg == keyword), given)
    if given is not None:
        facts.draws.setdefault(call.lineno, set()).update(names_in(given))


def _loop(
    facts: SourceFacts,
    target: ast.expr,
    over: ast.expr,
    span: tuple[int, int],
    names: Iterable[str],
) -> None:
    """Note one loop; ``names`` are those that stand for its turn."""
    values: list[Values] = []
    for part, iterable in _parts(target, over):
        _unpacks(facts, part)
        if span != _ANYWHERE:
            for each, given in _by_column(part, iterable):
                for name in names_in(each):
                    _comes(facts, name, given, span)
        rows = sequence_of(iterable, {**facts.records, **facts.constants})
        beside = " ".join(names_in(iterable))
        if rows is not None:
            places = dict(_unread(part))
            for name, column in _columns(part, rows):
                values.append(Values(name, beside, column, places.get(name)))
                values += [Values(n, n, c) for n, c in _looked_up(column, facts)]
        elif isinstance(iterable, ast.Name):
            values += [Values(name, beside, None, at) for name, at in _unread(part)]
        elif listed := counted(iterable, facts.constants):
            # `for i in range(len(DOSES))`: the turns are those of its items.
            values.append(Values(listed, listed, tuple(facts.constants[listed])))
    carriers = frozenset(names)
    if values and carriers:
        facts.runs.append(Loop(carriers, tuple(values), *span))


def _parts(target: ast.expr, over: ast.expr) -> Iterator[tuple[ast.expr, ast.expr]]:
    """Which part of the loop's target takes its values from which iterable."""
    called = over.func.id if isinstance(over, ast.Call) and isinstance(over.func, ast.Name) else ""
    if isinstance(over, ast.Call) and isinstance(target, ast.Tuple):
        if called == "zip" and len(over.args) == len(target.elts):
            for part, iterable in zip(target.elts, over.args, strict=True):
                yield from _parts(part, iterable)
            return
        if called == "enumerate" and over.args and len(target.elts) == 2:
            yield from _parts(target.elts[1], over.args[0])
            return
    yield target, over


def _by_column(target: ast.expr, over: ast.expr) -> Iterator[tuple[ast.expr, ast.expr]]:
    """Which part of a target takes its values from where in rows that stand in the loop itself."""
    rows = over.elts if isinstance(over, (ast.Tuple, ast.List)) else []
    cells = [row.elts for row in rows if isinstance(row, (ast.Tuple, ast.List))]
    if isinstance(target, ast.Tuple) and rows and len(cells) == len(rows):
        width = len(target.elts)
        if all(len(row) == width for row in cells):
            for at, part in enumerate(target.elts):
                yield from _by_column(part, ast.Tuple([row[at] for row in cells], ast.Load()))
            return
    yield target, over


def _columns(target: ast.expr, rows: Sequence[Any]) -> Iterator[tuple[str, tuple[Any, ...]]]:
    """The values that each name of a target takes, row by row; ``name key`` in rows of dicts."""
    if isinstance(target, (ast.Tuple, ast.List)):
        if all(isinstance(row, (tuple, list)) and len(row) == len(target.elts) for row in rows):
            for at, part in enumerate(target.elts):
                yield from _columns(part, [row[at] for row in rows])
    elif isinstance(target, ast.Name):
        yield target.id, tuple(rows)
        first = rows[0] if rows else None
        keys: Iterable[Any] = ()
        if isinstance(first, dict):
            keys = first
        elif isinstance(first, (tuple, list)):
            keys = range(len(first))
        for key in keys:
            try:
                yield f"{target.id} {key}", tuple(row[key] for row in rows)
            except (TypeError, KeyError, IndexError):
                continue


def _looked_up(
    column: tuple[Any, ...], facts: SourceFacts
) -> Iterator[tuple[str, tuple[Any, ...]]]:
    """What dicts hold for the values of a column: ``CONC[key]`` for each key."""
    keys = {item for item in column if isinstance(item, str)}
    if len(keys) == len(column) > 1:
        for name, value in (*facts.constants.items(), *facts.levels.items()):
            if isinstance(value, dict) and keys <= value.keys():
                yield name, tuple(value[key] for key in column)


def _unread(target: ast.expr) -> Iterator[tuple[str, int | None]]:
    """The names of a target, with their places in rows that only the rehearsal knows."""
    if isinstance(target, ast.Name):
        yield target.id, None
    elif isinstance(target, (ast.Tuple, ast.List)):
        for at, part in enumerate(target.elts):
            if isinstance(part, ast.Name):
                yield part.id, at
