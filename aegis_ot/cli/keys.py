"""Single keys from the terminal, without waiting for them."""

from __future__ import annotations

import contextlib
import select
import sys
from collections.abc import Iterator


class Keys:
    """Reads the keys p, r and s while it is open; where stdin is no terminal there are none."""

    def __init__(self) -> None:
        self.there = False

    @contextlib.contextmanager
    def open(self) -> Iterator[Keys]:
        """Take keys one by one instead of by the line."""
        try:
            import termios
            import tty

            number = sys.stdin.fileno()
            before = termios.tcgetattr(number)
        except (ImportError, OSError, ValueError, AttributeError):  # Windows, a pipe, no stdin
            yield self
            return
        except termios.error:
            yield self
            return
        try:
            tty.setcbreak(number)
            self.there = True
            yield self
        finally:
            self.there = False
            termios.tcsetattr(number, termios.TCSADRAIN, before)

    def pressed(self) -> str:
        """The next key, lower case; ``""`` if there is none."""
        if not self.there or not select.select([sys.stdin], [], [], 0)[0]:
            return ""
        return sys.stdin.read(1).lower()
