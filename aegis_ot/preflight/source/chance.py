"""What decides moves and may be another thing in the next run: chance, the clock, files, networks.

A rehearsal sees one course of such a protocol. The values are followed by name through the text, as
far as plain assignments and loops go; a source that reaches no move is not worth a word.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence

from .nodes import Nodes

_CHANCE, _CLOCK, _NETWORK = "chance (random)", "the clock", "the network"
_ENVIRONMENT = "the environment (os.environ)"
_MODULES: Mapping[str, str] = {
    **dict.fromkeys(("random", "secrets", "os.urandom", "uuid", "numpy.random"), _CHANCE),
    **dict.fromkeys(("time", "datetime"), _CLOCK),
    **dict.fromkeys(("requests", "urllib", "socket", "http.client"), _NETWORK),
    **dict.fromkeys(("os.environ", "os.getenv"), _ENVIRONMENT),
}
_FILE = ("open", "read_text", "read_bytes", "read_csv", "isfile", "exists")
_CALLS: Mapping[str, str] = {
    **dict.fromkeys(_FILE, "a file"),
    "input": "what somebody types",
    "is_simulating": "whether it is a simulation (is_simulating)",
}
_MENTIONED = re.compile(r"\b(?:" + "|".join(map(re.escape, (*_MODULES, *_CALLS))) + r")\b")
_IDLE = frozenset({"sleep", "strftime", "isoformat"})
_MOVES = frozenset(
    {
        "aspirate", "dispense", "transfer", "distribute", "consolidate", "mix", "pick_up_tip",
        "drop_tip", "return_tip", "blow_out", "touch_tip", "air_gap", "move_labware",
        "transfer_with_liquid_class", "distribute_with_liquid_class",
        "consolidate_with_liquid_class",
    }
)  # fmt: skip
_CHANGES = frozenset({"append", "extend", "insert", "pop", "remove", "reverse", "sort", "update"})
"""Methods that change a list or dict in place."""

_BINDINGS: Sequence[tuple[type[ast.AST], str, str]] = (
    (ast.Assign, "targets", "value"),
    (ast.AugAssign, "target", "value"),
    (ast.NamedExpr, "target", "value"),
    (ast.For, "target", "iter"),
    (ast.comprehension, "target", "iter"),
    (ast.withitem, "optional_vars", "context_expr"),
)
"""What gives names their values: the kind, its field for the names, and that for the value."""

_BRANCHES: tuple[type[ast.If | ast.While], ...] = (ast.If, ast.While)
_SEEDED = ("random.Random", "numpy.random.default_rng", "numpy.random.RandomState")
_LOADS = ("load_labware", "load_module", "load_adapter", "load_instrument", "define_liquid")


def chances(text: str, nodes: Nodes) -> dict[str, int]:
    """What decides moves, in words, with the line where it does so first."""
    if not _MENTIONED.search(text):
        return {}
    return _Chances(nodes).found()


class _Chances:
    def __init__(self, nodes: Nodes) -> None:
        self._nodes = nodes
        self._imported = dict(_imports(nodes))
        self._names: dict[str, str] = {}
        # Made once, since the walk takes longest: the rounds go through it again and again.
        self._bindings = [pair for pair in self._bound() if pair[0]]

    def found(self) -> dict[str, int]:
        before = -1
        while before < len(self._names):
            before = len(self._names)
            for targets, value in self._bindings:
                source = self._in(value)
                for part in (part for one in filter(None, targets) for part in ast.walk(one)):
                    if source and isinstance(part, ast.Name):
                        self._names.setdefault(part.id, source)
        lines: dict[str, int] = {}
        for source, line in self._reached():
            lines[source] = min(line, lines.get(source, line))
        return lines

    def _bound(self) -> Iterator[tuple[Sequence[ast.expr], ast.expr]]:
        """What is given a value, with the expression that this comes from."""
        of = self._nodes.of
        for kind, into, out_of in _BINDINGS:
            for node in of(kind):
                bound = getattr(node, into)
                yield bound if isinstance(bound, list) else [bound], getattr(node, out_of)
        for call in of(ast.Call):
            # What is shuffled, or read into, holds it from then on.
            source = self._source_of(call)
            if source == _CHANCE or _dotted(call.func).endswith(".shuffle"):
                yield call.args[:1], call
            for given in (*call.args, *(word.value for word in call.keywords)):
                yield _changed(call), given
        for branch in of(*_BRANCHES):
            # What is set or turned round under a condition holds what decides it.
            for part in (one for step in (*branch.body, *branch.orelse) for one in ast.walk(step)):
                if isinstance(part, ast.Assign) and not _loads(part.value):
                    held = [one for one in part.targets if not isinstance(one, ast.Attribute)]
                    yield held, branch.test
                elif isinstance(part, ast.Call):
                    yield _changed(part), branch.test

    def _reached(self) -> Iterator[tuple[str, int]]:
        for branch in self._nodes.of(*_BRANCHES):
            source = self._in(branch.test)
            if source and any(map(_decides, [*branch.body, *branch.orelse])):
                yield source, branch.lineno
        for call in self._nodes.of(ast.Call):
            for given in (*call.args, *(word.value for word in call.keywords)):
                if _moves(call) and (source := self._in(given)):
                    yield source, call.lineno

    def _in(self, value: ast.expr) -> str:
        """The source that an expression draws from, or ``""``."""
        for part in _parts(value):
            if isinstance(part, ast.Name) and part.id in self._names:
                return self._names[part.id]
            if isinstance(part, ast.Call) and (source := self._source_of(part)):
                return source
        return ""

    def _source_of(self, call: ast.Call) -> str:
        name = _dotted(call.func)
        first, _, rest = name.partition(".")
        full = ".".join(filter(None, (self._imported.get(first, ""), rest)))
        last = name.rpartition(".")[2]
        seeded = full in _SEEDED and call.args and isinstance(call.args[0], ast.Constant)
        if seeded or last in _IDLE:
            return ""
        fitting = (said for module, said in _MODULES.items() if f"{full}.".startswith(f"{module}."))
        return next(fitting, _CALLS.get(last, ""))


def _parts(value: ast.expr) -> Iterator[ast.AST]:
    """All of an expression but what labware is loaded from, which says nothing of moves."""
    open_: list[ast.AST] = [value]
    while open_:
        part = open_.pop()
        if not _loads(part):
            yield part
            open_ += ast.iter_child_nodes(part)


def _loads(part: ast.AST) -> bool:
    return isinstance(part, ast.Call) and _dotted(part.func).rpartition(".")[2].startswith(_LOADS)


def _changed(call: ast.Call) -> list[ast.expr]:
    """The name of the list or dict that a call changes in place."""
    func = call.func
    if isinstance(func, ast.Attribute) and func.attr in _CHANGES:
        return [func.value] if isinstance(func.value, ast.Name) else []
    return []


def _imports(nodes: Nodes) -> Iterator[tuple[str, str]]:
    for plain in nodes.of(ast.Import):
        for alias in plain.names:
            first = alias.name.partition(".")[0]
            yield alias.asname or first, alias.name if alias.asname else first
    for taken in nodes.of(ast.ImportFrom):
        for alias in taken.names:
            yield alias.asname or alias.name, f"{taken.module or ''}.{alias.name}"


def _dotted(node: ast.expr) -> str:
    """``np.random.choice`` of such an expression; of another one its last name, or ``""``."""
    if isinstance(node, ast.Attribute):
        return f"{_dotted(node.value)}.{node.attr}"
    return node.id if isinstance(node, ast.Name) else ""


def _decides(statement: ast.stmt) -> bool:
    """Whether a statement moves something, or leaves out what comes after it."""
    return any(
        isinstance(part, (ast.Return, ast.Break, ast.Continue)) or _moves(part)
        for part in ast.walk(statement)
    )


def _moves(part: ast.AST) -> bool:
    called = part.func if isinstance(part, ast.Call) else None
    return isinstance(called, ast.Attribute) and called.attr in _MOVES
