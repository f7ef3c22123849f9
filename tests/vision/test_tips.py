"""Tip geometry: volumes and heights."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.tips import TIPS, TipGeometry, is_flex, pipette_class, tip_for


@pytest.mark.parametrize("tip", TIPS.values(), ids=lambda tip: tip.name)
def test_height_and_volume_are_inverse(tip: TipGeometry) -> None:
    volumes = np.linspace(0.0, tip.capacity_ul, 101)
    heights = tip.height_of(volumes)
    assert np.all(np.diff(heights) > 0)
    np.testing.assert_allclose(tip.volume_of(heights), volumes, atol=1e-6 * tip.capacity_ul)
    # The same against plain integration of the bore's cross-section.
    z = np.linspace(0.0, tip.free_mm, 20001)
    area = np.pi * tip.inner_radius(z) ** 2
    whole = float(np.sum((area[1:] + area[:-1]) / 2 * np.diff(z)))
    assert tip.capacity_ul == pytest.approx(whole, rel=1e-4)


@pytest.mark.parametrize("tip", TIPS.values(), ids=lambda tip: tip.name)
def test_a_tip_holds_its_nominal_volume_below_the_nozzle(tip: TipGeometry) -> None:
    assert tip.capacity_ul >= 1.02 * tip.nominal_ul
    assert tip.profile[-1][0] == tip.length_mm


@pytest.mark.parametrize("tip", TIPS.values(), ids=lambda tip: tip.name)
def test_mm_per_ul_is_the_slope(tip: TipGeometry) -> None:
    volume = 0.4 * tip.nominal_ul
    step = 1e-3 * tip.nominal_ul
    slope = (tip.height_of(volume + step) - tip.height_of(volume - step)) / (2 * step)
    assert tip.mm_per_ul(volume) == pytest.approx(slope, rel=1e-2)


@pytest.mark.parametrize("by", [-1e-15, 0.0, 1e-15])
def test_out_of_range_is_clipped(by: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """On any processor: their cube roots differ in the last digit."""
    cbrt = np.cbrt
    monkeypatch.setattr(np, "cbrt", lambda x: cbrt(x) * (1 + by))
    tip = TIPS["ot2_300"]
    assert tip.height_of(-5.0) == 0.0
    assert tip.volume_of(-1.0) == 0.0
    assert tip.height_of(1e6) == pytest.approx(tip.length_mm)
    assert tip.height_of(1e6) <= tip.length_mm
    assert tip.volume_of(1e6) <= tip.volume_of(tip.length_mm)
    assert isinstance(tip.height_of(10.0), float)


def test_lengths_are_those_of_the_labware_definitions() -> None:
    labware = pytest.importorskip("opentrons_shared_data.labware")
    racks = {
        "ot2_20": "opentrons_96_tiprack_20ul",
        "ot2_300": "opentrons_96_tiprack_300ul",
        "ot2_1000": "opentrons_96_tiprack_1000ul",
        "flex_50": "opentrons_flex_96_tiprack_50ul",
        "flex_200": "opentrons_flex_96_tiprack_200ul",
        "flex_1000": "opentrons_flex_96_tiprack_1000ul",
    }
    for name, rack in racks.items():
        definition = labware.load_definition(rack, 1)
        assert TIPS[name].length_mm == pytest.approx(definition["parameters"]["tipLength"])
        assert TIPS[name].overlap_mm == pytest.approx(definition["parameters"]["tipOverlap"])
        assert TIPS[name].nominal_ul == definition["wells"]["A1"]["totalLiquidVolume"]


@pytest.mark.parametrize(
    ("pipette", "capacity", "name"),
    [
        ("p20_single_gen2", None, "ot2_20"),
        ("p20", 20.0, "ot2_20"),
        ("p10_single", None, "ot2_10"),
        ("p50_single", None, "ot2_300"),
        ("p300_multi_gen2", 200.0, "ot2_200"),
        ("p300", None, "ot2_300"),
        ("p1000_single_gen2", 1000.0, "ot2_1000"),
        ("flex_1channel_1000", 200.0, "flex_200"),
        ("flex_8channel_50", None, "flex_50"),
        ("flex_96channel_1000", None, "flex_1000"),
        ("p1000_multi_flex", 50.0, "flex_50"),
        ("p1000_96", None, "flex_1000"),
        ("homemade", None, "ot2_300"),
    ],
)
def test_tip_for(pipette: str, capacity: float | None, name: str) -> None:
    assert tip_for(pipette, capacity).name == name


def test_pipette_names() -> None:
    assert pipette_class("p1000_single_gen2") == "p1000"
    assert pipette_class("flex_1channel_50") == "p50"
    assert pipette_class("odd") == "odd"
    assert is_flex("flex_8channel_1000")
    assert not is_flex("p300_multi_gen2")
