"""What an experiment is, and what comes of one: plain values, so that it can be kept as JSON."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .context import Context

NOT_RUN = "not run"
"""How the answer begins where something was left out, and why it was."""


@dataclass(frozen=True)
class Table:
    """A table of the page: a counterpart of one of the paper's, or what it has no table for.

    Attributes:
        title: What it shows.
        header: Names of the columns.
        rows: Texts; as many in each row as in the header.
    """

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class ExperimentPicture:
    """A figure of the page: a PNG in the output folder, and what it shows."""

    file: str
    caption: str


@dataclass(frozen=True)
class ExperimentOutcome:
    """What came of an experiment.

    Attributes:
        data: What it stands on, each beginning with ``simulated``, ``rendered``, ``real`` or
            ``protocols``.
        answers: Our counterpart of rows of the paper's table, by their key; a line each.
        tables: For the page.
        pictures: For the page.
        notes: What a reader has to know.
        figures: All numbers. The same for the same seed, options and version.
        timings: Numbers that depend on the machine, s.
    """

    data: tuple[str, ...]
    answers: Mapping[str, tuple[str, ...]]
    tables: tuple[Table, ...] = ()
    pictures: tuple[ExperimentPicture, ...] = ()
    notes: tuple[str, ...] = ()
    figures: Mapping[str, Any] = field(default_factory=dict)
    timings: Mapping[str, Any] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return asdict(self)

    @classmethod
    def from_json(cls, kept: Mapping[str, Any]) -> ExperimentOutcome:
        """From plain values; raises what malformed ones raise."""
        return cls(
            tuple(kept["data"]),
            {row: tuple(lines) for row, lines in kept["answers"].items()},
            tuple(
                Table(one["title"], tuple(one["header"]), tuple(map(tuple, one["rows"])))
                for one in kept["tables"]
            ),
            tuple(ExperimentPicture(one["file"], one["caption"]) for one in kept["pictures"]),
            tuple(kept["notes"]),
            dict(kept["figures"]),
            dict(kept["timings"]),
        )


@dataclass(frozen=True)
class Experiment:
    """One entry of the list.

    Attributes:
        name: What ``--only`` calls it.
        title: For people.
        place: Where in the paper its counterpart stands.
        rows: Rows of the paper's table that it answers.
        uses: Options that its result depends on: a result that was kept is taken up if these,
            the seed and the version are the same.
        run: Makes the outcome.
    """

    name: str
    title: str
    place: str
    rows: tuple[str, ...]
    uses: tuple[str, ...]
    run: Callable[[Context], ExperimentOutcome]


def table(title: str, header: Sequence[str], rows: Sequence[Sequence[object]]) -> Table:
    """A table of anything that can be written."""
    return Table(title, tuple(header), tuple(tuple(map(str, row)) for row in rows))
