"""What holds of every run: volumes are conserved, contact grows as the tip goes down."""

from __future__ import annotations

import math
import re
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aegis_ot.adapters.opentrons.instrumentation import WellInfo
from aegis_ot.preflight.trace import Contact, Tip, Well, trace_table
from aegis_ot.preflight.trace.geometry import Geometry
from aegis_ot.preflight.trace.model import Layer
from aegis_ot.vocabulary import WellRef
from tests.support.bench import Bench

SHAPES = {
    "flat": WellInfo(360, 10.67, diameter=6.86, bottom="flat"),
    "cone": WellInfo(200, 14.8, diameter=5.5, bottom="v"),
    "half ball": WellInfo(360, 10.9, diameter=6.5, bottom="u"),
    "trough": WellInfo(15_000, 26.85, x_size=8.2, y_size=71.2, bottom="v"),
    "sections": WellInfo(
        200,
        12,
        diameter=6,
        sections=(
            {"shape": "spherical", "radiusOfCurvature": 1.5, "bottomHeight": 0, "topHeight": 1},
            {
                "shape": "conical",
                "bottomDiameter": 2.8,
                "topDiameter": 6,
                "bottomHeight": 1,
                "topHeight": 12,
            },
        ),
    ),
}
heights = st.floats(0, 30)


@pytest.mark.parametrize("shape", SHAPES)
@settings(deadline=None)
@given(low=heights, high=heights)
def test_more_stands_below_a_greater_height(shape: str, low: float, high: float) -> None:
    geometry = Geometry(SHAPES[shape])
    low, high = sorted((low, high))
    assert 0 <= geometry.volume_below(low) <= geometry.volume_below(high) <= geometry.brim * 2


def test_shapes_hold_what_their_formulas_say() -> None:
    cone = WellInfo(1000, 10, diameter=10, sections=({
        "shape": "conical", "bottomDiameter": 0, "topDiameter": 10,
        "bottomHeight": 0, "topHeight": 10,
    },))  # fmt: skip
    assert Geometry(cone).volume_below(10) == pytest.approx(math.pi * 25 * 10 / 3)
    assert Geometry(cone).volume_below(5) == pytest.approx(math.pi * 25 * 10 / 3 / 8)
    ball = WellInfo(100, 5, diameter=10, sections=({
        "shape": "spherical", "radiusOfCurvature": 5, "bottomHeight": 0, "topHeight": 5,
    },))  # fmt: skip
    assert Geometry(ball).volume_below(5) == pytest.approx(2 / 3 * math.pi * 125)
    box = WellInfo(100, 6, x_size=8, y_size=8, sections=({
        "shape": "cuboidal", "bottomXDimension": 4, "topXDimension": 8, "xCount": 2,
        "bottomYDimension": 4, "topYDimension": 8, "bottomHeight": 0, "topHeight": 6,
    },))  # fmt: skip
    assert Geometry(box).volume_below(6) == pytest.approx(2 * 6 / 3 * (16 + 64 + 32))


def test_a_v_bottom_of_which_no_more_is_known_narrows_as_pcr_wells_do() -> None:
    v, flat = (
        Geometry(WellInfo(200, 10, diameter=6, bottom=bottom)).volume_below(2)
        for bottom in ("v", "flat")
    )
    assert v / flat == pytest.approx(0.33, abs=0.01)


@pytest.mark.parametrize("shape", SHAPES)
@settings(deadline=None)
@given(
    volume=st.floats(0, 300),
    low=st.floats(0.1, 12),
    high=st.floats(0.1, 12),
    known=st.booleans(),
)
def test_a_deeper_tip_touches_no_less(
    shape: str, volume: float, low: float, high: float, known: bool
) -> None:
    info = SHAPES[shape]
    well = Well(WellRef("plate", "A1"), 0, info.max_volume, Geometry(info))
    well.fill_before_run(volume if known else None)
    low, high = sorted((low, high))
    deep, shallow = (well.contact(height - info.depth, height) for height in (low, high))
    assert deep >= shallow


@settings(deadline=None)
@given(st.lists(st.tuples(st.booleans(), st.floats(0.5, 100)), max_size=20))
def test_what_leaves_a_tip_had_been_drawn(moves: list[tuple[bool, float]]) -> None:
    tip, source = Tip(0), Well(WellRef("source", "A1"))
    drawn = given_off = 0.0
    for draws, volume in moves:
        if draws:
            tip.layers.append(Layer(source, volume, source.liquid(), 1))
            drawn += volume
        else:
            given_off += sum(part.volume for part in tip.pop(volume))
    given_off += sum(part.volume for part in tip.pop())
    assert given_off == pytest.approx(drawn, abs=1e-3)
    assert not tip.layers


_WELLS = st.sampled_from([f"{labware}:{name}" for labware in ("source", "plate") for name in
                          ("A1", "B1", "C1")])  # fmt: skip
_MOVE = st.tuples(_WELLS, _WELLS, st.floats(1, 60), st.booleans())


@settings(max_examples=60, deadline=None)
@given(st.lists(_MOVE, min_size=1, max_size=25))
def test_volumes_are_conserved(moves: list[tuple[str, str, float, bool]]) -> None:
    """What all wells hold in the end is what they held before; no well knows less than nothing."""
    bench = Bench()
    names = [f"{labware}:{name}" for labware in ("source", "plate") for name in ("A1", "B1", "C1")]
    for name in names:
        bench.load(name, 2000)
    for source, target, volume, fresh in moves:
        bench.pick()
        bench.draw(source, volume)
        if fresh:
            bench.air(5)
        bench.give(target, volume + 5 * fresh)
        bench.drop()
    wells = bench.trace().wells.values()
    assert sum(well.volume for well in wells) == pytest.approx(2000 * len(names))
    for well in wells:
        assert sum(well.contents.values()) == pytest.approx(well.volume, rel=1e-6)
        assert sum(well.liquid().values()) == pytest.approx(1)
        assert 0 <= well.least <= well.volume + 1e-6


@settings(max_examples=40, deadline=None)
@given(st.lists(_MOVE, min_size=1, max_size=30))
def test_what_a_tip_has_met_never_grows_less(moves: list[tuple[str, str, float, bool]]) -> None:
    bench = Bench()
    bench.pick()
    for source, target, volume, high in moves:
        bench.draw(source, volume)
        bench.give(target, volume, top=1.0 if high else -9.0)
    visits = bench.trace().visits
    for before, after in pairwise(visits):
        assert before.carried <= after.carried
        assert before.met <= after.met
    for visit in visits:
        for met in visit.tip.touched.values():
            assert met.contact(math.inf) is not Contact.CLEAR


@settings(max_examples=30, deadline=None)
@given(
    st.lists(st.lists(_MOVE, min_size=1, max_size=6), min_size=1, max_size=40),
    st.integers(300, 2000),
)
def test_a_table_fits_and_leaves_no_tip_session_out(
    sessions: list[list[tuple[str, str, float, bool]]], limit: int
) -> None:
    bench = Bench()
    for number, moves in enumerate(sessions):
        bench.pick(f"{'ABCDEFGH'[number % 8]}{number // 8 + 1}")
        for source, target, volume, _ in moves:
            bench.draw(source, volume)
            bench.give(target, volume)
        bench.drop()
    table = trace_table(bench.trace(), limit)
    assert sum(map(len, table)) <= limit or len(table) == 1
    told = sum(int(found[1] or 1) for found in re.finditer(_HEAD, "\n".join(table), re.M))
    assert told == len(sessions)


_HEAD = r"tips? [\d,.-]+(?:, (\d+) pick-ups[a-z, ]*)?(?:, [^:;]*USED BEFORE)?:"
