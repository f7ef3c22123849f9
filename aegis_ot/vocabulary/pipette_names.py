"""What Opentrons' names of pipettes say: ``p300_multi_gen2``, ``flex_8channel_1000``."""

from __future__ import annotations


def channels_of(name: str) -> int:
    """Nozzles of a pipette, from its Opentrons name."""
    if "96" in name:
        return 96
    return 8 if "multi" in name or "8channel" in name else 1
