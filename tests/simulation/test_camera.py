"""The simulated camera behind the camera interface."""

from __future__ import annotations

import threading
import time
from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.errors import CameraError, ConfigurationError
from aegis_ot.simulation import SessionParameters, SimulatedCamera
from aegis_ot.simulation.exposure import decode
from aegis_ot.simulation.render import render_jpeg
from aegis_ot.simulation.scene import SceneState, TipContent
from aegis_ot.vision.camera import Camera
from aegis_ot.vocabulary import Keyframe
from aegis_ot_lab.drawing.random_sessions import random_session

from .test_faults import run_of


def frame_of(camera: SimulatedCamera, keyframe: Keyframe) -> np.ndarray:
    camera.announce(keyframe)
    return camera.frame_after(time.monotonic(), 60.0).image


def test_it_is_a_camera() -> None:
    camera: Camera = SimulatedCamera()
    now = time.monotonic()
    frame = camera.frame_after(now, 5.0)
    assert camera.kind == "simulated"
    assert frame.exposed_at >= now
    assert frame.image.shape == (480, 640, 3)
    assert frame.image.dtype == np.uint8
    assert np.array_equal(decode(frame.jpeg), frame.image)


def test_it_shows_what_the_tip_holds_at_each_keyframe() -> None:
    camera = SimulatedCamera(faults=["partial:50@B1"])
    held, present = [], []
    for keyframe in run_of(["A1", "B1"], 200.0):
        frame_of(camera, keyframe)
        assert camera.truth is not None
        held.append(camera.truth.tip.liquid_ul)
        present.append(camera.truth.kind is keyframe.kind)
    assert all(present)
    assert held == pytest.approx([200, 200, 0, 0, 200, 200, 100, 100], rel=0.08, abs=1e-6)


def test_another_renderer_draws_what_stands_there() -> None:
    drawn = []

    def render(state, session, rng):
        drawn.append(state)
        return render_jpeg(state, session, rng)

    camera = SimulatedCamera(3, render=render)
    keyframe = run_of(["A1"], 200.0)[0]
    shown = frame_of(camera, keyframe)
    assert [one.kind for one in drawn] == [keyframe.kind]
    assert np.array_equal(shown, frame_of(SimulatedCamera(3), keyframe))


def test_a_resent_keyframe_looks_the_same() -> None:
    frames = run_of(["A1", "B1"])
    camera = SimulatedCamera(seed=3, faults=["no_dispense@A1"])
    shown = [frame_of(camera, keyframe) for keyframe in frames]
    assert np.array_equal(frame_of(camera, frames[2]), shown[2])
    second = camera.frame_after(time.monotonic(), 60.0).image
    assert not np.array_equal(second, shown[2])

    twin = SimulatedCamera(seed=3, faults=["no_dispense@A1"])
    assert all(
        np.array_equal(frame_of(twin, keyframe), image)
        for keyframe, image in zip(frames, shown, strict=True)
    )
    other = SimulatedCamera(seed=4, faults=["no_dispense@A1"])
    assert not np.array_equal(frame_of(other, frames[0]), shown[0])
    elsewhere = replace(frames[0], run="another")
    assert not np.array_equal(frame_of(SimulatedCamera(seed=3), elsewhere), shown[0])


def test_reagent_colours_can_be_given() -> None:
    keyframe = replace(run_of(["A1"])[1], reagent="sample 4", expected_ul=250.0)
    shown = []
    for colour in ("red", "blue"):
        camera = SimulatedCamera(reagent_colours={"Sample 4": colour})
        image = frame_of(camera, keyframe).astype(float)
        assert camera.truth is not None
        assert camera.truth.dye == colour
        assert camera.truth.tip.column_top is not None
        (x, bottom), (_, top) = camera.truth.tip.orifice, camera.truth.tip.column_top
        column = image[int(top) + 12 : int(bottom) - 20, int(x) - 2 : int(x) + 3]
        shown.append(column.mean(axis=(0, 1)))
    assert shown[0][2] > shown[0][0] + 5
    assert shown[1][0] > shown[1][2] + 5
    with pytest.raises(ConfigurationError, match="not known"):
        SimulatedCamera(reagent_colours={"sample": "mauve"})


def test_wrong_settings_are_refused() -> None:
    with pytest.raises(ConfigurationError, match="rate"):
        SimulatedCamera(rate=0)
    with pytest.raises(ConfigurationError, match="no kind of fault"):
        SimulatedCamera(faults=["typo@A1"])


def test_a_free_running_camera_exposes_after_the_moment() -> None:
    camera = SimulatedCamera(rate=30.0)
    camera.frame_after(time.monotonic(), 60.0)
    for _ in range(3):
        moment = time.monotonic()
        frame = camera.frame_after(moment, 60.0)
        assert moment <= frame.exposed_at <= moment + 1 / 30 + 1e-6
        assert time.monotonic() >= frame.exposed_at


def test_a_slow_camera_is_a_camera_error() -> None:
    camera = SimulatedCamera(rate=0.01)
    camera.frame_after(time.monotonic() - 1.0, 200.0)
    with pytest.raises(CameraError, match="within"):
        camera.frame_after(time.monotonic() + 1.0, 0.05)


def test_close_ends_a_wait_and_what_follows() -> None:
    camera = SimulatedCamera(rate=0.02)
    caught: list[Exception] = []

    def wait() -> None:
        try:
            camera.frame_after(time.monotonic() + 0.5, 60.0)
        except CameraError as error:
            caught.append(error)

    waiting = threading.Thread(target=wait)
    waiting.start()
    camera.close()
    waiting.join(timeout=60.0)
    assert not waiting.is_alive()
    assert len(caught) == 1
    camera.close()
    with pytest.raises(CameraError, match="closed"):
        camera.frame_after(time.monotonic() - 1, 100.0)


def test_a_multi_channel_pipette_shows_all_its_tips() -> None:
    camera = SimulatedCamera(faults=["no_dispense@C2", "no_tip@F2"])
    camera.expect(run_of(["A2"], channels=8))
    for keyframe in run_of(["A2"], channels=8):
        frame_of(camera, keyframe)
    truth = camera.truth
    assert truth is not None
    assert [tip.box is not None for tip in truth.tips] == [True] * 5 + [False] + [True] * 2
    assert [tip.liquid_ul > 50 for tip in truth.tips] == [i == 2 for i in range(8)]
    # Seen from the corner, neighbours stand apart.
    places = np.array([tip.orifice[0] for tip in truth.tips])
    assert np.abs(np.diff(places)).min() > 10


def test_ninety_six_channels_show_their_front_row() -> None:
    keyframe = replace(
        run_of(["A1"])[1], channels=96, pipette="flex_96channel_1000", capacity_ul=1000.0
    )
    camera = SimulatedCamera()
    frame_of(camera, keyframe)
    assert camera.truth is not None
    assert len(camera.truth.tips) == 12


def test_odd_wells_and_missing_wells_do_not_fail() -> None:
    keyframe = run_of(["A1"])[2]
    bare = replace(keyframe, sources=(), destinations=(), reagent=None)
    far = replace(
        keyframe, sequence=9, destinations=(replace(keyframe.destinations[0], name="AF48"),)
    )
    camera = SimulatedCamera()
    for odd in (bare, far):
        assert frame_of(camera, odd).shape == (480, 640, 3)


def test_own_parameters_are_used() -> None:
    session = random_session(np.random.default_rng(2), pipette="p300", size=(960, 540))
    image = SimulatedCamera(parameters=session).frame_after(time.monotonic(), 60.0).image
    assert image.shape == (540, 960, 3)


def test_specks_are_a_tips_own_and_tell_nothing_of_what_it_holds() -> None:
    worn = replace(SessionParameters.bench(), specks=8.0, noise=0.1, axis_jitter_px=0.0)
    drawn = []

    def render(state, session, rng):
        drawn.append(state)
        return render_jpeg(state, session, rng)

    camera = SimulatedCamera(1, parameters=worn, reagent_colours={"sample": "water"}, render=render)
    frame_of(camera, run_of(["A1"], 200.0)[-1])
    (emptied,) = drawn

    def specks(state: SceneState) -> np.ndarray:
        shown, clean = (
            decode(render_jpeg(state, session, np.random.default_rng(5))[0]).astype(int)
            for session in (worn, replace(worn, specks=0.0))
        )
        return (shown - clean).sum(axis=2) > 100

    own = specks(emptied)
    full = specks(replace(emptied, contents=(TipContent(liquid_ul=200.0),)))
    another = specks(replace(emptied, tip_name="another"))
    assert own.any()
    assert (own & full).sum() > 0.7 * own.sum()
    assert (own & another).sum() < 0.3 * own.sum()
