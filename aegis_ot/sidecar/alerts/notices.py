"""What people are told of: a bad well, or trouble. One notice per incident."""

from __future__ import annotations

from dataclasses import dataclass

from ...vocabulary import Outcome, Verdict

TODO = {
    "fail": "Look at the frames, then confirm or correct on the page, and resume or stop the run.",
    "undecided": "Look at the frames and decide on the page.",
    "camera": "Look at the camera, its cable and its view; the robot sends the keyframe again.",
    "store": "Look at the workstation's disk: free space, permissions.",
    "model": "Look at the model's service, key and network; flagged wells come to you meanwhile.",
    "recovered": "Nothing has to be done; the well is marked in the report.",
    "hold": "Look at the robot, and at the sidecar's page.",
    "layer1": "Compare the run with its protocol; pause or stop it on the page if it is not meant.",
    "silent": "See whether the robot is on and in the network.",
}


@dataclass(frozen=True)
class Notice:
    """One thing that happened.

    Attributes:
        run: Of which run.
        kind: A key of :data:`TODO`.
        what: In a few words, for a title.
        seen: In a sentence.
        trajectory: Which delivery; ``None`` for trouble.
    """

    run: str
    kind: str
    what: str
    seen: str
    trajectory: int | None = None

    @classmethod
    def of_verdict(cls, verdict: Verdict) -> Notice:
        """A well that failed or is undecided."""
        failure = verdict.failure.words if verdict.failure else "failed"
        failed = verdict.outcome is Outcome.FAIL
        return cls(
            verdict.run,
            verdict.outcome.value,
            failure if failed else "your decision is needed",
            verdict.reason or "No reason was given.",
            verdict.trajectory,
        )

    @property
    def todo(self) -> str:
        """What to do about it."""
        return TODO[self.kind]
