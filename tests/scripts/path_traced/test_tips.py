"""A tip cut into the surfaces that light meets: closed, of the right volume, facing outwards."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.simulation.dyes import DYES
from aegis_ot.simulation.scene import TipContent
from aegis_ot.vision.tips import TIPS
from scripts.path_traced.lathe import Surface, turn
from scripts.path_traced.tips import Liquid, tip_surfaces


def volume(*surfaces: Surface) -> float:
    """Enclosed by surfaces whose normals face outwards, by the divergence theorem."""
    total = 0.0
    for surface in surfaces:
        a, b, c = (surface.points[surface.faces[:, i]] for i in range(3))
        total += float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6
    return total


def test_normals_and_faces_look_the_same_way() -> None:
    can = turn([(0.0, 1e-4), (0.0, 2.0), (5.0, 2.0), (5.0, 1e-4)])
    a, b, c = (can.points[can.faces[:, i]] for i in range(3))
    facing = np.cross(b - a, c - a)
    facing /= np.maximum(np.linalg.norm(facing, axis=1, keepdims=True), 1e-12)
    assert (np.einsum("ij,ij->i", facing, can.normals[can.faces[:, 0]]) > 0.95).all()
    assert volume(can) == pytest.approx(np.pi * 4 * 5, rel=0.01)


@pytest.mark.parametrize("name", ["ot2_20", "ot2_300", "ot2_1000", "flex_1000"])
@pytest.mark.parametrize("gap", [0.0, 0.1])
def test_the_liquid_has_its_volume(name: str, gap: float) -> None:
    tip = TIPS[name]
    drawn = 0.5 * tip.nominal_ul
    content = TipContent(liquid_ul=drawn, gap_ul=gap * tip.nominal_ul, gap_below_ul=0.4 * drawn)
    parts = tip_surfaces(tip, content, Liquid(DYES["red"]), 40.0)
    assert len(parts.wet_bore) == (2 if gap else 1)
    assert volume(*parts.wet_bore, *parts.liquid) == pytest.approx(drawn, rel=0.05)


def test_an_empty_tip_is_dry_and_no_tip_is_bare() -> None:
    tip = TIPS["ot2_300"]
    dry = tip_surfaces(tip, TipContent(), Liquid(DYES["red"]), 40.0)
    assert dry.wet_bore == dry.liquid == ()
    bare = tip_surfaces(tip, TipContent(present=False), Liquid(DYES["red"]), 40.0)
    assert bare.plastic == ()
    assert bare.shaft.points[:, 2].min() == pytest.approx(tip.length_mm)


def test_a_stronger_dye_and_a_wider_column_take_more_light() -> None:
    red = Liquid(DYES["red"])
    through = red.left(3.6)
    assert through[0] > through[1], "red light passes"
    assert (Liquid(DYES["red"], 2.0).left(3.6) < through).all()
    parts = tip_surfaces(TIPS["ot2_1000"], TipContent(liquid_ul=500.0), red, 40.0)
    colour = parts.wet_bore[0].colour
    assert colour is not None
    assert colour[-1, 2] < colour[0, 2]
