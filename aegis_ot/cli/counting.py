"""How many files are done, in one line on stderr; on a terminal only."""

from __future__ import annotations

import sys
from typing import Any

_WIDTH = 60


class Counting:
    """A context manager; the line is gone when it ends.

    Args:
        total: How many files there are; of one alone nothing is shown.
    """

    def __init__(self, total: int) -> None:
        self._total = total
        self._count = 0
        self._shown = total > 1 and sys.stderr.isatty()

    def __enter__(self) -> Counting:
        self._say(f"0/{self._total}")
        return self

    def __exit__(self, *_: object) -> None:
        self._say("", "\r")

    def done(self, one: Any) -> None:
        """One is done: anything with a ``file``."""
        self._count += 1
        self._say(f"{self._count}/{self._total} {one.file}")

    def _say(self, text: str, end: str = "") -> None:
        if self._shown:
            print(f"\r{text[:_WIDTH]:{_WIDTH}}", end=end, file=sys.stderr, flush=True)
