"""What only the text of a protocol can tell: comments, docstrings, constants, subscripts.

The rehearsal knows which wells were used; the text knows what the scientist wrote about them.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Place:
    """``rack[MASTER_MIX]``: a labware name, how it was indexed, and by which names.

    Attributes:
        labware: The expression that holds the labware, ``"rack"``.
        names: Names that stand in the index, ``("MASTER_MIX",)``.
        value: The index, where constants give it: ``"A1"``, ``95``, a list of these; else
            ``None``.
        kind: ``well``, ``wells``, ``columns`` or ``rows``: what is indexed.
        line: Where it stands.
        keys: Keys and attributes in the index: ``"tube"`` in ``rack[row["tube"]]``.
        partly: Whether only some of what stands there is taken: ``plate.columns()[NTC][:6]``.
        made: Whether the index is put together: ``plate[well[0] + "3"]``.
        keyed_by: Names that are only keys to what stands there: ``code`` in
            ``plate[wells_of[code]]``.
    """

    labware: str
    names: tuple[str, ...]
    value: Any
    kind: str
    line: int
    keys: tuple[str, ...] = ()
    partly: bool = False
    made: bool = False
    keyed_by: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Values:
    """What one name of a loop holds in turn.

    Attributes:
        name: The name, with the key where rows are dicts or tuples: ``"std conc"``.
        source: The names in what the loop runs over.
        column: The values; ``None`` where ``source`` is no literal.
        at: Place of the name in each row that ``source`` holds; ``None`` for the whole row.
    """

    name: str
    source: str
    column: tuple[Any, ...] | None
    at: int | None = None


@dataclass(frozen=True)
class Loop:
    """A loop over literals, or over names that the rehearsal may know.

    Attributes:
        names: Names whose value changes with each turn; for a comprehension, its result.
        values: What the names of its target hold, as far as that is known.
        first: First line on which it counts.
        last: Last such line.
    """

    names: frozenset[str]
    values: tuple[Values, ...]
    first: int
    last: int


@dataclass(frozen=True)
class Numbered:
    """A name that counts columns or names rows: ``c`` in ``plate[f"A{c}"]``.

    Attributes:
        labware: The name of the labware.
        axis: ``column`` or ``row``.
        name: The name.
        first: Its value for the first column or row, where it is a number.
        lines: The line where it stands, and the one that calls the helper in which it stands.
        fixed: Index of the row of a column's wells, or of the column of a row's, if one is given.
        across: The name that gives it otherwise, or ``""``.
        across_first: What ``first`` is for that name.
        partly: Whether only some of these wells are taken: ``plate.columns()[c][:6]``.
        key: Of a name that is a row of a table, the column that counts: ``row["col"]``.
    """

    labware: str
    axis: str
    name: str
    first: int
    lines: tuple[int, ...]
    fixed: int | None = None
    across: str = ""
    across_first: int = 0
    partly: bool = False
    key: str = ""


@dataclass
class SourceFacts:
    """The facts of one protocol text.

    Attributes:
        comments: Comment text by line.
        indents: Spaces between the ``#`` and the text of each comment.
        own_line: Lines that hold nothing but a comment.
        among_code: Lines with a comment that does not begin in the first column.
        docstrings: Module and function docstrings, and other free-standing strings.
        metadata: Values of the ``metadata`` dict.
        constants: Names bound to literals, by name.
        parameters: Names of runtime parameters among these constants.
        places: Subscripts of labware by names or constants.
        numbered: Names that count columns or name rows of a labware.
        loose: Names that are loop variables or parameters, as ``(function, name)``.
        loops: Those of them that are loop variables.
        notes: Comment beside or right above the assignment of a name, by that name.
        item_notes: For names bound to a list of a line for each item, the comments beside these.
        key_notes: For names bound to a dict of several lines, the comments beside these with the
            keys that stand there.
        assigned: Line of the first assignment of each name.
        tables: For names bound to a list of rows or to a dict, the constants of each row.
        records: For names bound to a list of objects or ``dict(...)``, the fields of each.
        blocks: For the first line of a run of statements without a gap, all lines of it.
        arguments: By line, the names that calls draw from and give to, as ``(side, name)``.
        liquids: Description of each liquid defined in the text, by its name.
        comes_from: For each name, the names that its values are made of, with the first and the
            last line on which that holds.
        keyed_by: For each name, those of these names that are only keys to its values.
        asked: For each name, the keys in what its values are made of, with the lines as above.
        called_at: For each parameter of a function, the lines that call it.
        runs: Loops over literals and over names.
        unpacked: The names of each target that takes a row apart: ``well, (kind, source) = ...``.
        draws: By line, all names in what a call draws from.
        levels: By unit, the amounts that a text lists under the names of what holds them.
        within: By line, the function that it belongs to, with the function's first line.
        names: Every identifier of the text, once.
        strings: Every other string of the text, with its line.
    """

    comments: dict[int, str] = field(default_factory=dict)
    indents: dict[int, int] = field(default_factory=dict)
    own_line: set[int] = field(default_factory=set)
    among_code: set[int] = field(default_factory=set)
    docstrings: list[tuple[int, str]] = field(default_factory=list)
    metadata: dict[str, str] = field(default_factory=dict)
    constants: dict[str, Any] = field(default_factory=dict)
    parameters: set[str] = field(default_factory=set)
    places: list[Place] = field(default_factory=list)
    numbered: list[Numbered] = field(default_factory=list)
    loose: set[tuple[str, str]] = field(default_factory=set)
    loops: set[tuple[str, str]] = field(default_factory=set)
    notes: dict[str, str] = field(default_factory=dict)
    item_notes: dict[str, tuple[str, ...]] = field(default_factory=dict)
    key_notes: dict[str, dict[str, tuple[str, ...]]] = field(default_factory=dict)
    assigned: dict[str, int] = field(default_factory=dict)
    tables: dict[str, list[tuple[Any, ...]]] = field(default_factory=dict)
    records: dict[str, list[dict[str, Any]]] = field(default_factory=dict)
    blocks: dict[int, tuple[int, ...]] = field(default_factory=dict)
    arguments: dict[int, list[tuple[str, str]]] = field(default_factory=dict)
    liquids: dict[str, str] = field(default_factory=dict)
    comes_from: dict[str, set[tuple[str, int, int]]] = field(default_factory=dict)
    keyed_by: dict[str, set[str]] = field(default_factory=dict)
    asked: dict[str, set[tuple[str, int, int]]] = field(default_factory=dict)
    called_at: dict[str, set[int]] = field(default_factory=dict)
    runs: list[Loop] = field(default_factory=list)
    unpacked: list[tuple[str, ...]] = field(default_factory=list)
    draws: dict[int, set[str]] = field(default_factory=dict)
    levels: dict[str, dict[str, float]] = field(default_factory=dict)
    within: dict[int, tuple[str, int]] = field(default_factory=dict)
    names: set[str] = field(default_factory=set)
    strings: list[tuple[int, str]] = field(default_factory=list)
