"""Kinds of camera: the tip stands in the frame before each of them."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.simulation.optics import Pinhole
from aegis_ot.simulation.scene import TipContent, place_tip
from aegis_ot.vision.tips import tip_for
from aegis_ot.vocabulary import KeyframeKind
from scripts.path_traced.kinds import KINDS, LATER_KINDS, draw_session

ALL = {**KINDS, **LATER_KINDS}


@pytest.mark.parametrize("name", ALL)
def test_the_tip_is_in_the_frame_over_either_labware(name: str) -> None:
    rng = np.random.default_rng(8)
    for number in range(12):
        pipette = ALL[name].pipettes[number % 2]
        session, lamps = draw_session(ALL[name], pipette, rng)
        tip, camera = tip_for(pipette), Pinhole(session)
        for kind in KeyframeKind:
            state = place_tip(session, kind, tip, (TipContent(),), source="A1", destination="A12")
            x, y, z = state.orifice
            ends = camera.project([(x, y, z), (x, y, z + 0.7 * tip.length_mm)])
            assert (ends[:, 0] > 0).all()
            assert (ends[:, 0] < session.size[0]).all()
            assert (ends[:, 1] > -0.1 * session.size[1]).all()
            assert (ends[:, 1] < session.size[1]).all()
        assert lamps.strength > 0
