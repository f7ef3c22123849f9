"""One measured figure, and how it is printed."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    """What was measured, on what, and what was hoped for.

    Attributes:
        what: The quantity.
        data: What it was measured on.
        source: ``"simulated"``, ``"rendered"`` or ``"real"`` frames, ``"simulator"`` for
            Opentrons' own, ``"test pattern"``, or ``""`` where nothing was looked at.
        value: In ``unit``.
        unit: ``"ms"``, ``"x"``, ``"%"``, ``"MB"``, or ``""``.
        target: What is asked for, or ``None``.
        at_least: Whether more is better.
        note: Anything a reader needs to judge the value.
    """

    what: str
    data: str
    source: str
    value: float
    unit: str = ""
    target: float | None = None
    at_least: bool = False
    note: str = ""

    @property
    def met(self) -> bool | None:
        """Whether the target is met; ``None`` without one."""
        if self.target is None:
            return None
        return self.value >= self.target if self.at_least else self.value <= self.target

    def line(self) -> str:
        """One line of text."""
        label = f"{self.source}; " if self.source else ""
        text = f"  {self.what:<58} {self.value:>9.3g} {self.unit:<2}"
        if self.target is not None:
            sign = ">=" if self.at_least else "<="
            verdict = "met" if self.met else "MISSED"
            text += f"  target {sign} {self.target:g} {self.unit}: {verdict}"
        text += f"   [{label}{self.data}]"
        return f"{text}\n      {self.note}" if self.note else text
