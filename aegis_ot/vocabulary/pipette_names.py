"""What Opentrons' names of pipettes say: ``p300_multi_gen2``, ``flex_8channel_1000``."""

from __future__ import annotations

import re


def channels_of(name: str) -> int:
    """Nozzles of a pipette, from its Opentrons name."""
    if "96" in name:
        return 96
    return 8 if "multi" in name or "8channel" in name else 1


def largest_volume(name: str) -> float:
    """Of a pipette, µL, from its Opentrons name: ``p300_single_gen2``, ``flex_1channel_50``."""
    found = re.search(r"^p(\d+)_", name) or re.search(r"_(\d+)$", name)
    return float(found.group(1)) if found else 1000.0


def least_volume(name: str) -> float:
    """What a pipette of any generation is made to move at least, µL, from its name."""
    least = {10.0: 1.0, 20.0: 1.0, 50.0: 5.0, 300.0: 20.0, 1000.0: 100.0}
    is_flex = "flex" in name or "96" in name
    return 1.0 if is_flex else least.get(largest_volume(name), 1.0)
