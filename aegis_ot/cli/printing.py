"""A console for texts that hold names from protocols, robots and stores."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rich.console import Console
from rich.segment import Segment

from .plain_text import plain


class PlainConsole(Console):
    """A console whose own escape sequences are the only ones that it prints."""

    def render(self, *args: Any, **kwargs: Any) -> Iterator[Segment]:
        """As Rich does."""
        for part in super().render(*args, **kwargs):
            yield part if part.control else Segment(plain(part.text), part.style)
