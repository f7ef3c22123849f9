"""Sleeves of path-traced tips hold their bore."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.tips import TIPS
from scripts.path_traced.tips import Sleeve, _sleeved


@pytest.mark.parametrize("name", sorted(TIPS))
@pytest.mark.parametrize("share", [0.1, 0.25, 0.4])
def test_the_outside_stays_outside(name: str, share: float) -> None:
    tip = TIPS[name]
    surface = _sleeved(tip, Sleeve(share, 0.1, 0.0, 16, 0.2))
    heights, radii = surface.points[:, 2], np.hypot(*surface.points[:, :2].T)
    wall = (heights > 1.0) & (heights < 0.99 * tip.length_mm)
    assert (radii[wall] > tip.inner_radius(heights[wall]) + 0.01).all()
