"""How a delivery stands, in a word."""

from __future__ import annotations

from ..vocabulary import FailureType, KeyframeKind
from .overview import ChannelEntry, DeliveryEntry, channels_of, last_keyframe, verdict_of

_ALL_OF_IT = 0.95
"""Share of the volume from which on all of it stayed in the tip."""


def state_of(trajectory: DeliveryEntry) -> str:
    """How a delivery stands, in one word: ``fail``, ``recovered`` (failed, and put right by the
    robot), ``undecided`` (also where no verdict will come any more), ``pass``,
    ``calibration``, ``waiting`` (for its verdict), ``running`` (keyframes are still to come),
    ``abandoned``, or ``unobserved`` where the camera saw none of its tips.
    """
    if trajectory["abandoned"] is not None:
        return "abandoned"
    verdict = trajectory["verdict"]
    if trajectory.get("awaiting") or (not verdict and trajectory.get("unjudged")):
        return "undecided"
    if verdict:
        if verdict["outcome"] == "fail" and trajectory.get("recovered"):
            return "recovered"
        told = channels_of(trajectory)
        unseen = bool(told) and all(channel["outcome"] == "unobserved" for channel in told)
        if unseen and verdict["outcome"] == "pass" and not trajectory["decisions"]:
            return "unobserved"
        calibrates = verdict["outcome"] == "pass" and verdict["route"] == "calibration"
        return "calibration" if calibrates else str(verdict["outcome"])
    kinds = {keyframe["kind"] for keyframe in trajectory["keyframes"]}
    return "waiting" if KeyframeKind.POST_DISPENSE.value in kinds else "running"


def failure_in_words(trajectory: DeliveryEntry, said: ChannelEntry | None = None) -> str:
    """What went wrong: ``"partial dispense"``; ``""`` where nothing is said.

    Args:
        trajectory: Of the run's overview.
        said: What is said of one of its channels, instead of its verdict.
    """
    verdict = said or verdict_of(trajectory)
    failure, stayed = str(verdict.get("failure") or ""), verdict.get("measured_ul")
    if failure == FailureType.PARTIAL_DISPENSE.value and stayed is not None:
        drawn = float(last_keyframe(trajectory).get("commanded_ul") or 0.0)
        # The record is careful to say that all of it stayed; a person who reads the figures is not.
        if drawn and stayed - float(verdict.get("expected_ul") or 0.0) >= _ALL_OF_IT * drawn:
            failure = FailureType.NO_DISPENSE.value
    return failure.replace("_", " ")
