"""Progress bars on stderr for the long commands."""

from __future__ import annotations

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    ProgressColumn,
    TaskID,
    TextColumn,
    TimeElapsedColumn,
)
from rich.progress import Progress as Bar

from ..progress import Progress
from .printing import PlainConsole


def progress_bar(console: Console, *more: ProgressColumn) -> Bar:
    """What is done, how far it is, and for how long; it is gone when it is over."""
    return Bar(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        *more,
        console=console,
        transient=True,
    )


class StageBar(Progress):
    """Shows stages as a bar; where stderr is no terminal, one line a stage. A context manager."""

    def __init__(self) -> None:
        self._console = PlainConsole(stderr=True, highlight=False)
        self._bar = progress_bar(self._console)
        self._task: TaskID | None = None

    def __enter__(self) -> StageBar:
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def begin(self, what: str, total: int) -> None:
        if self._task is not None:
            self._bar.remove_task(self._task)
        self._task = self._bar.add_task(what, total=total)
        if not self._console.is_terminal:
            self._console.print(f"{what} ({total})", markup=False)

    def step(self) -> None:
        if self._task is not None:
            self._bar.advance(self._task)
