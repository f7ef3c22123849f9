"""What stands behind a score, as the evidence of a verdict tells it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..vision.signs import SIGNS, Sign


def signs_in(evidence: Mapping[str, Any]) -> list[tuple[Sign, float]]:
    """The signs behind a score and what each says, nats; the strongest first."""
    told = sorted(evidence.get("signs", {}).items(), key=lambda sign: -sign[1])
    return [(SIGNS.get(name) or Sign(name, name.replace("_", " ")), nats) for name, nats in told]


def band_in(evidence: Mapping[str, Any]) -> tuple[float, float] | None:
    """From where to where a score passed silently when the well was judged; one that is open
    below begins at 0. ``None`` before a band was set."""
    low, high = evidence.get("band") or (None, None)
    if high is None:
        return None
    return 0.0 if low is None or math.isinf(low) else float(low), float(high)
