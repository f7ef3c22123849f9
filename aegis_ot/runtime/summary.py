"""What Layer 2 has to say at the end of a run."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..vocabulary import Outcome, Verdict, unobserved


@dataclass
class WatchSummary:
    """Counts of one run.

    Attributes:
        watching: Whether Layer 2 acted at all (it does not in an analysis).
        verdicts: Verdict by trajectory, as far as one is in and counts.
        places: Destination of each trajectory in plain words.
        lost: Trajectories without a verdict that counts, and why.
        recovered: Failed trajectories that the robot put right by itself.
        attempts: Trajectories that were to put another one right, with that one: it is counted,
            and not they.
        abandoned: Trajectories that were never delivered.
        keyframes: Keyframes acknowledged.
        hold_s: Time spent at boundaries, s.
        longest_hold_s: The longest of them, s.
        outages: How often the sidecar was lost.
    """

    watching: bool = False
    verdicts: dict[int, Verdict] = field(default_factory=dict)
    places: dict[int, str] = field(default_factory=dict)
    lost: dict[int, str] = field(default_factory=dict)
    recovered: set[int] = field(default_factory=set)
    attempts: dict[int, int] = field(default_factory=dict)
    abandoned: set[int] = field(default_factory=set)
    keyframes: int = 0
    hold_s: float = 0.0
    longest_hold_s: float = 0.0
    outages: int = 0

    def of(self, outcome: Outcome) -> tuple[int, ...]:
        """Trajectories with this outcome, rising; those of which nobody saw a tip have none."""
        return tuple(
            sorted(
                number
                for number, verdict in self.verdicts.items()
                if verdict.outcome is outcome
                and not verdict.unobserved
                and number not in self.attempts
            )
        )

    @property
    def watched(self) -> int:
        """Trajectories that ended with a verdict or without one, the abandoned left out."""
        return len((self.verdicts.keys() | self.lost.keys()) - self.attempts.keys())

    def held(self, seconds: float) -> None:
        """Count one hold."""
        self.hold_s += seconds
        self.longest_hold_s = max(self.longest_hold_s, seconds)

    def text(self) -> str:
        """One line for a comment in the run log."""
        if not self.watching:
            return "This is a simulation; Layer 2 watches the run itself."
        failed = tuple(n for n in self.of(Outcome.FAIL) if n not in self.recovered)
        recovered = tuple(sorted(self.recovered))
        # A delivery without a verdict is no pass.
        open_ = tuple(sorted(self.lost.keys() - self.attempts.keys()))
        undecided = tuple(sorted({*self.of(Outcome.UNDECIDED), *open_}))
        parts = [f"{len(self.of(Outcome.PASS))} passed"]
        if failed:
            parts.append(f"{len(failed)} failed ({self._wells(failed)})")
        if recovered:
            parts.append(f"{len(recovered)} put right ({self._wells(recovered)})")
        if undecided:
            parts.append(f"{len(undecided)} undecided ({self._wells(undecided)})")
        if open_:
            parts.append(f"{len(open_)} of them without a verdict")
        hidden = unobserved(self.verdicts.values())
        if hidden:
            parts.append(f"{len(hidden)} wells unobserved: the camera did not see their tips")
        return (
            f"Layer 2 watched {self.watched} deliveries: {', '.join(parts)}; "
            f"held {self.hold_s:.1f} s in all, {self.longest_hold_s:.2f} s at most."
        )

    def _wells(self, numbers: tuple[int, ...], most: int = 6) -> str:
        named = [self.places.get(n) or f"trajectory {n}" for n in numbers[:most]]
        rest = len(numbers) - most
        return ", ".join(named) + (f" and {rest} more" if rest > 0 else "")
