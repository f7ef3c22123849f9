"""The webcam preset against the figures measured on real frames (simulated frames here)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from aegis_ot.simulation import FrameTruth, SessionParameters, place_tip, render_jpeg
from aegis_ot.simulation.dyes import DYES, GREEN, WATER, Dye, dye_for
from aegis_ot.simulation.exposure import decode, frame_gain
from aegis_ot.simulation.render import render
from aegis_ot.simulation.scene import TipContent
from aegis_ot.vision.tips import tip_for
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot_lab.drawing.random_sessions import random_session

P1000 = tip_for("p1000")
Floats = NDArray[np.float64]

WEBCAM = SessionParameters.webcam()
STEADY = replace(WEBCAM, exposure_jitter=0.0, overexposed_chance=0.0)
"""The preset with its exposure held still."""
QUIET = replace(
    STEADY, noise=0.0, axis_jitter_px=0.0, meniscus_jitter_px=0.0, row_offset=0.0, jpeg_quality=98
)
LIGHT = replace(
    QUIET, wall=(150.0,) * 3, backdrop_top=(150.0,) * 3, brightness_fall=0.0, vignette=0.0
)
"""The preset without anything random, before a light panel, where edges are plain to measure."""


def shot(
    parameters: SessionParameters,
    content: TipContent,
    dye: Dye = GREEN,
    kind: KeyframeKind = KeyframeKind.TRANSIT,
    seed: int = 0,
) -> tuple[Floats, FrameTruth]:
    state = place_tip(parameters, kind, P1000, (content,), dye, source="A3", destination="C4")
    jpeg, truth = render_jpeg(state, parameters, np.random.default_rng(seed))
    return decode(jpeg).astype(float), truth


def along_axis(image: Floats, truth: FrameTruth, half_width: int = 2) -> Floats:
    """Mean colour across the axis, one row per pixel row from the collar down, ``(n, 3)``."""
    (x0, y0), (x1, y1) = truth.tip.orifice, truth.tip.collar
    rows = np.arange(max(int(y1), 0), int(y0))
    centres = x0 + (x1 - x0) * (rows + 0.5 - y0) / (y1 - y0)
    return np.array(
        [
            image[y, int(x) - half_width : int(x) + half_width + 1].mean(axis=0)
            for y, x in zip(rows, centres, strict=True)
        ]
    )


def column_profile(volume: float) -> tuple[Floats, float]:
    """Red ratio of a filled to an empty tip along the axis, and the first row's y."""
    full, truth = shot(LIGHT, TipContent(liquid_ul=volume))
    empty, _ = shot(LIGHT, TipContent())
    ratio = along_axis(full, truth) / along_axis(empty, truth)
    return ratio[:, 2], float(max(int(truth.tip.collar[1]), 0))


def crossing(profile: Floats, level: float) -> float:
    """Sub-pixel place where a falling profile first passes a level."""
    i = int(np.argmax(profile < level))
    a, b = profile[i - 1], profile[i]
    return float(i - 1 + (a - level) / (a - b) + 0.5)


def meniscus_of(volume: float) -> tuple[float, float]:
    """Measured y of the meniscus, and its 10-90 % width, px."""
    profile, top = column_profile(volume)
    plateau = float(np.median(profile[int(crossing(profile, 0.75)) + 12 :][:15]))
    middle, first, last = (crossing(profile, 1 + (plateau - 1) * f) for f in (0.5, 0.1, 0.9))
    return top + middle, last - first


def test_px_per_ul() -> None:
    places = [meniscus_of(volume)[0] for volume in (100.0, 200.0, 300.0, 400.0, 500.0)]
    assert np.all(np.diff(places) < 0)
    assert (places[0] - places[-1]) / 400.0 == pytest.approx(0.18, abs=0.01)


def test_meniscus_edge_is_nine_px_wide() -> None:
    widths = [meniscus_of(volume)[1] for volume in (250.0, 300.0, 350.0)]
    assert np.mean(widths) == pytest.approx(9.0, abs=1.5)


def test_truth_says_where_the_column_ends() -> None:
    for volume in (150.0, 300.0, 450.0):
        _, truth = shot(LIGHT, TipContent(liquid_ul=volume))
        assert truth.tip.column_top is not None
        assert meniscus_of(volume)[0] == pytest.approx(truth.tip.column_top[1], abs=2.0)
        assert truth.tip.liquid_ul == pytest.approx(volume)


def test_noise_is_that_of_the_webcam() -> None:
    frames = np.stack([shot(STEADY, TipContent(), seed=seed)[0] for seed in range(8)])
    grey = frames @ (0.114, 0.587, 0.299)
    # The front of the labware, about mid grey, where nothing moves.
    patch = grey[:, 400:440, 20:60]
    assert 90 < patch.mean() < 160
    assert patch.std(axis=0, ddof=1).mean() == pytest.approx(1.7, abs=0.35)


def test_exposure_drifts_and_now_and_then_fails() -> None:
    ratios, over = [], []
    for seed in range(250):
        rng = np.random.default_rng((seed, 5))
        gain = frame_gain(WEBCAM, rng)
        (over if gain > 1.5 else ratios).append(gain)
    assert np.std(ratios) == pytest.approx(0.025, rel=0.25)
    assert 1 <= len(over) <= 10
    bright, truth = shot(replace(WEBCAM, overexposed_chance=1.0), TipContent())
    normal, _ = shot(STEADY, TipContent())
    assert truth.overexposed
    assert (bright >= 254).mean() > 0.1 > (normal >= 254).mean()


def test_axis_repeats_to_less_than_half_a_pixel() -> None:
    places = [shot(STEADY, TipContent(), seed=seed)[1].tip.orifice for seed in range(40)]
    assert np.std(places, axis=0, ddof=1) == pytest.approx([0.4, 0.4], abs=0.15)


def test_meniscus_repeats_to_less_than_half_a_pixel() -> None:
    rows = []
    for seed in range(40):
        tip = shot(STEADY, TipContent(liquid_ul=300.0), seed=seed)[1].tip
        assert tip.column_top is not None
        rows.append(tip.orifice[1] - tip.column_top[1])
    assert 0.19 <= np.std(rows, ddof=1) <= 0.45


def test_brightness_falls_towards_the_top() -> None:
    flat = replace(
        QUIET, labware=(), wall=(150.0,) * 3, backdrop_top=(150.0,) * 3, deck=(150.0,) * 3,
        vignette=0.0,
    )  # fmt: skip
    state = place_tip(WEBCAM, KeyframeKind.TRANSIT, P1000, (TipContent(present=False),))
    image = render(state, flat, np.random.default_rng(0)).astype(float)
    assert image[:20, 500:].mean() / image[-20:, 500:].mean() == pytest.approx(0.88, abs=0.01)


def test_green_dye_transmits_as_measured() -> None:
    dyed, truth = shot(LIGHT, TipContent(liquid_ul=400.0))
    clear, _ = shot(LIGHT, TipContent(liquid_ul=400.0), WATER)
    height = P1000.height_of(300.0) / P1000.length_mm
    row = truth.tip.orifice[1] + height * (truth.tip.collar[1] - truth.tip.orifice[1])
    at = int(row - max(int(truth.tip.collar[1]), 0))
    ratio = (along_axis(dyed, truth) / along_axis(clear, truth))[at - 4 : at + 5].mean(axis=0)
    assert ratio == pytest.approx(GREEN.transmission, abs=0.03)


def test_absorption_follows_the_path() -> None:
    """Beer-Lambert: the wider the column, the darker, as a power of the path."""
    dyed, truth = shot(LIGHT, TipContent(liquid_ul=900.0))
    clear, _ = shot(LIGHT, TipContent(liquid_ul=900.0), WATER)
    logs = np.log((along_axis(dyed, truth, 0) / along_axis(clear, truth, 0))[:, 2])
    found = []
    for volume in (100.0, 600.0):
        share = P1000.height_of(volume) / P1000.length_mm
        y = truth.tip.orifice[1] + share * (truth.tip.collar[1] - truth.tip.orifice[1])
        at = int(y - max(int(truth.tip.collar[1]), 0))
        radius = P1000.inner_radius(P1000.height_of(volume))
        found.append(logs[at - 5 : at + 6].mean() / radius)
    assert found[0] == pytest.approx(found[1], rel=0.15)


@pytest.mark.parametrize("parameters", [QUIET, LIGHT], ids=["dark panel", "light panel"])
def test_water_shows_by_edges_and_glints_only(parameters: SessionParameters) -> None:
    water, truth = shot(parameters, TipContent(liquid_ul=300.0), WATER)
    dyed, _ = shot(parameters, TipContent(liquid_ul=300.0), DYES["red"])
    empty, _ = shot(parameters, TipContent(), WATER)
    # Colour: the same balance of channels as in an empty tip, unlike a dye.
    change = along_axis(water, truth) / along_axis(empty, truth)
    tinted = along_axis(dyed, truth) / along_axis(empty, truth)
    assert np.abs(change - change.mean(axis=1, keepdims=True)).max() < 0.05
    assert np.abs(tinted - tinted.mean(axis=1, keepdims=True)).max() > 0.2
    # Some of its pixels change, but far less than with a dye.
    box = truth.box
    assert box is not None
    x, y, w, h = (int(v) for v in box)
    part = np.s_[max(y, 0) : y + h, x - 3 : x + w + 3]
    by_water = np.abs(water[part] - empty[part]).mean()
    by_dye = np.abs(dyed[part] - empty[part]).mean()
    assert 0.2 < by_water < 0.5 * by_dye


def test_a_bubble_parts_the_column() -> None:
    content = TipContent(liquid_ul=300.0, gap_ul=30.0, gap_below_ul=120.0)
    image, truth = shot(LIGHT, content, DYES["red"])
    whole, _ = shot(LIGHT, TipContent(liquid_ul=330.0), DYES["red"])
    ((low, high),) = truth.tip.gaps
    top = max(int(truth.tip.collar[1]), 0)
    at = int((low[1] + high[1]) / 2 - top)
    assert low[1] > high[1]
    assert along_axis(image, truth)[at, 1] > 1.3 * along_axis(whole, truth)[at, 1]


def test_labware_hides_the_end_of_a_tip_in_a_well() -> None:
    content = TipContent(liquid_ul=300.0)
    for kind in KeyframeKind:
        image, truth = shot(QUIET, content, DYES["red"], kind)
        inside = kind in (KeyframeKind.ASPIRATE, KeyframeKind.DISPENSE)
        assert (truth.tip.hidden > 0.05) == inside
        none, _ = shot(QUIET, TipContent(present=False), DYES["red"], kind)
        x, y = (int(v) for v in truth.tip.orifice)
        end = np.abs(image - none)[y - 8 : y, x - 3 : x + 4].max()
        assert (end < 6) == inside


def test_a_retained_film_and_a_drop_are_seen() -> None:
    clean, truth = shot(LIGHT, TipContent(), DYES["red"], KeyframeKind.POST_DISPENSE)
    filmed, _ = shot(
        LIGHT, TipContent(film_ul=3.0, film_to_ul=300.0), DYES["red"], KeyframeKind.POST_DISPENSE
    )
    dropped, _ = shot(LIGHT, TipContent(drop_ul=4.0), DYES["red"], KeyframeKind.POST_DISPENSE)
    assert 0.3 < np.abs(along_axis(filmed, truth) - along_axis(clean, truth)).mean() < 25
    x, y = (int(v) for v in truth.tip.orifice)
    assert np.abs(dropped - clean)[y : y + 6, x - 3 : x + 4].max() > 30


def test_no_tip_leaves_the_shaft() -> None:
    image, truth = shot(QUIET, TipContent(present=False), kind=KeyframeKind.DISPENSE)
    assert truth.box is None
    (x0, y0), (x1, y1) = truth.tip.orifice, truth.tip.collar

    def level(share: float) -> float:
        x, y = int(x0 + share * (x1 - x0)), int(y0 + share * (y1 - y0))
        return float(image[y - 2 : y + 3, x - 1 : x + 2].mean())

    assert level(1.03) > level(0.6) + 60


def test_box_holds_the_tip_and_no_more() -> None:
    with_tip, truth = shot(LIGHT, TipContent(liquid_ul=900.0), DYES["red"])
    without, _ = shot(LIGHT, TipContent(present=False), DYES["red"])
    assert truth.box is not None
    x, y, w, h = truth.box
    changed = np.abs(with_tip - without).max(axis=2) > 12
    rows, columns = np.nonzero(changed)
    assert columns.min() >= x - 4
    assert columns.max() <= x + w + 4
    assert rows.max() == pytest.approx(y + h, abs=6)
    assert w == pytest.approx(2 * 3.8 * WEBCAM.px_per_mm, rel=0.2)


def test_the_same_seed_gives_the_same_frame() -> None:
    first, _ = shot(WEBCAM, TipContent(liquid_ul=200.0), seed=4)
    again, _ = shot(WEBCAM, TipContent(liquid_ul=200.0), seed=4)
    other, _ = shot(WEBCAM, TipContent(liquid_ul=200.0), seed=5)
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


@pytest.mark.parametrize("channels", [1, 8])
def test_a_guarded_robot_holds_a_tip_at_one_place_before_and_after_its_dispense(
    channels: int,
) -> None:
    wells = {"source": "A3", "destination": "C4"}
    there = [
        place_tip(WEBCAM, kind, P1000, (TipContent(),) * channels, **wells).orifice
        for kind in (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE)
    ]
    assert there[0] == there[1]


@pytest.mark.parametrize("pipette", ["p20", "p300_multi_gen2", "flex_1channel_1000"])
def test_drawn_sessions_keep_the_tip_in_view(pipette: str) -> None:
    tip = tip_for(pipette)
    for seed in range(6):
        session = random_session(np.random.default_rng(seed), pipette=pipette)
        again = random_session(np.random.default_rng(seed), pipette=pipette)
        assert session == again
        contents = (TipContent(liquid_ul=tip.nominal_ul / 3),) * (8 if "multi" in pipette else 1)
        for kind in (KeyframeKind.ASPIRATE, KeyframeKind.POST_DISPENSE):
            state = place_tip(session, kind, tip, contents, source="A2", destination="H11")
            _, truth = render_jpeg(state, session, np.random.default_rng(0))
            assert len(truth.tips) == len(contents)
            for x, y in (truth.tip.orifice, truth.tip.collar):
                assert 0 <= x <= 640
                assert 0 <= y <= 480


@pytest.mark.parametrize(
    ("reagent", "name"),
    [
        ("Red dye", "red"),
        ("yellow", "yellow"),
        ("Nuclease-free water", "water"),
        ("Tris buffer", "water"),
        ("BLUE food colour", "blue"),
        (None, "green"),
        ("", "green"),
    ],
)
def test_reagent_names(reagent: str | None, name: str) -> None:
    assert dye_for(reagent).name == name


def test_unknown_reagents_have_a_colour_of_their_own() -> None:
    assert dye_for("compound 7") == dye_for(" Compound 7")
    assert not dye_for("compound 7").is_clear
    assert dye_for("compound 7", {"Compound 7": WATER}) == WATER
