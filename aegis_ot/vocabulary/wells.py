"""Which well is meant, unmistakably, even after plates were swapped."""

from __future__ import annotations

from dataclasses import dataclass, field

from .sentences import printable


@dataclass(frozen=True)
class WellRef:
    """One well of one physical piece of labware.

    Two references are equal when labware and well are: the same plate stays the same plate
    when the gripper moves it, and a fresh plate in the old slot is another one.

    Attributes:
        labware: Key of the labware, unique within a run.
        name: Well name as Opentrons writes it, ``"A1"``.
        label: What the scientist called the labware, or its display name.
        slot: Where the labware stood at that moment (``"4"``, ``"C2"``), or ``""`` off deck.
    """

    labware: str
    name: str
    label: str = field(default="", compare=False)
    slot: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        # A reading of a long run looks wells up some 100,000 times.
        object.__setattr__(self, "_hash", hash((self.labware, self.name)))

    def __hash__(self) -> int:
        return self._hash  # type: ignore[attr-defined, no-any-return]

    def __reduce__(self) -> tuple[type, tuple[str, ...]]:
        # Another process hashes texts in another way.
        return WellRef, (self.labware, self.name, self.label, self.slot)

    @property
    def address(self) -> str:
        """Short form for reports and benchmark labels: ``slot:well``, ``"4:H12"``."""
        return printable(f"{self.slot or self.label or self.labware}:{self.name}")

    def __str__(self) -> str:
        place = f"slot {self.slot}" if self.slot else "off deck"
        return printable(f"{self.name} of {self.label} ({place})") if self.label else self.address
