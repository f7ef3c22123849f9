"""What stands behind a score, as the evidence of a verdict tells it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ..vision.signs import SIGNS, Sign


def signs_in(evidence: Mapping[str, Any]) -> list[tuple[Sign, float]]:
    """The signs behind a score and what each says, nats; the strongest first."""
    told = sorted(evidence.get("signs", {}).items(), key=lambda sign: -sign[1])
    return [(SIGNS.get(name) or Sign(name, name.replace("_", " ")), nats) for name, nats in told]


def limits_in(evidences: Iterable[Mapping[str, Any]]) -> list[float | None]:
    """Up to which score each well of a run could pass silently; ``None`` before a band was set.

    The band in a well's evidence is the one that came of it. A well that scored high and was found
    right has widened it, so the band that it met is that of its liquid's well before.

    Args:
        evidences: Of the wells in the order in which they were judged.
    """
    known: dict[tuple[str, ...], float | None] = {}
    limits = []
    for evidence in evidences:
        stream = tuple(map(str, (evidence.get("calibration") or {}).get("stream") or ()))
        after = (evidence.get("band") or (None, None))[1]
        # Of a row the evidence is the gravest tip's, and each tip has a band of its own.
        limits.append(after if "lanes" in evidence else known.get(stream))
        known[stream] = after
    return limits
