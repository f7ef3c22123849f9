"""A progress bar on stderr for the long commands of Layer 2."""

from __future__ import annotations

from rich.progress import BarColumn, MofNCompleteColumn, TaskID, TextColumn, TimeElapsedColumn
from rich.progress import Progress as Bar

from ..progress import Progress
from .printing import PlainConsole


class Shown(Progress):
    """Shows stages as a bar; where stderr is no terminal, one line a stage. A context manager."""

    def __init__(self) -> None:
        self._console = PlainConsole(stderr=True, highlight=False)
        self._bar = Bar(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            console=self._console,
            transient=True,
        )
        self._task: TaskID | None = None

    def __enter__(self) -> Shown:
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
