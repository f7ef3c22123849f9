"""What an audit found, as plain values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

FORMAT, VERSION = "aegis-ot audit", 1


@dataclass(frozen=True)
class Suspect:
    """A silent pass, or several that share one cause, for a person to look at.

    Attributes:
        kind: ``"well"``, ``"drift"`` (a liquid's later wells differ from its first ones) or
            ``"no_liquid"`` (none was ever seen in any well of a liquid).
        trajectories: The deliveries it is about.
        wells: Their wells.
        score: How unusual, nats, a rank and no probability.
        why: Sentences, the strongest first.
        stands_out: Whether it is over the limit from which a person should look.
        shown: The delivery whose frames show it best.
        model: What a vision model said of it; ``None`` where none was asked.
    """

    kind: str
    trajectories: tuple[int, ...]
    wells: tuple[str, ...]
    score: float
    why: tuple[str, ...]
    stands_out: bool
    shown: int
    model: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class Audit:
    """The look back at one run.

    Attributes:
        run: Its identifier.
        at: When, seconds since the epoch.
        frames: ``"simulated"`` or ``"real"``.
        wells: How many were looked at.
        left_out: How many could not be: frames are missing or late, or they were given up.
        silent: How many of them had passed without a person's decision.
        suspects: The silent passes, the most suspect first.
        costs: Of asking a vision model, by model; empty if none was asked.
        notes: What else must be said.
        plate: What two pictures of a plate say, as plain values; ``None`` where none were given.
    """

    run: str
    at: float
    frames: str
    wells: int
    left_out: int
    silent: int
    suspects: Sequence[Suspect]
    costs: Sequence[Mapping[str, Any]] = ()
    notes: Sequence[str] = ()
    plate: Mapping[str, Any] | None = None

    @property
    def standing_out(self) -> list[Suspect]:
        """What a person should look at."""
        return [one for one in self.suspects if one.stands_out]

    def to_json(self) -> dict[str, Any]:
        """Plain values, ranked; what the store keeps."""
        suspects = [
            {"rank": rank} | asdict(one) | {"score": round(one.score, 2)}
            for rank, one in enumerate(self.suspects, 1)
        ]
        return {"format": FORMAT, "version": VERSION} | asdict(self) | {"suspects": suspects}
