"""How far a long computation is, told to whoever shows it."""

from __future__ import annotations


class Progress:
    """Told of stages and of steps within them. This one shows nothing."""

    def begin(self, what: str, total: int) -> None:
        """A stage of ``total`` steps begins."""

    def step(self) -> None:
        """One step of the stage is done."""
