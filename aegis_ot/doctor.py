"""``aegis-ot doctor``: is everything in place for a run? One line each, with what to do."""

from __future__ import annotations

import json
import platform
import shutil
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from dataclasses import dataclass
from email.utils import parsedate_to_datetime
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from ._version import __version__
from .errors import AegisError, CameraError, StoreError
from .llm import make_backend
from .llm.backends.service import ServiceBackend
from .settings import load_settings
from .sidecar.aiming import Aim
from .sidecar.alerts.sending import Notifier
from .sidecar.analysers import load_scorer
from .sidecar.cameras import FreeRunning, open_camera
from .sidecar.config import CameraSettings, SidecarConfig, is_loopback
from .sidecar.store import DATABASE, Store
from .sidecar.token_file import TOKEN_FILE
from .vision.camera import Camera
from .vision.models import SHIPPED, load_model
from .vocabulary import counted, without_secrets
from .worldmodel.reach import Smallest, limits_in, normals_in, shortcomings, smallest_in

_LEAST_FREE_GB = 2.0
_FIRST_FRAME_S = 8.0
_WAITS = 6
"""Frames that are waited for, to see how long one takes."""
_LONG_WAIT = 0.7
"""Share of the time that a frame may take, from which on some may take longer."""
_CLOCK_S = 5.0
"""A robot's clock that is off by more makes its run log hard to read beside the frames, s."""
_PACKAGES = ("opentrons", "onnxruntime", "opencv-python-headless", "fastapi")
_DIRECT = urllib.request.build_opener(urllib.request.ProxyHandler({}))


@dataclass(frozen=True)
class Examination:
    """One thing that was looked at.

    Attributes:
        name: What.
        state: ``"ok"``, ``"warning"`` (a run is possible) or ``"bad"``.
        said: What was found.
        todo: What to do; empty if nothing.
    """

    name: str
    state: str
    said: str
    todo: str = ""


def examine(config: SidecarConfig, robot: str | None = None) -> Iterator[Examination]:
    """Look at everything, one after the other; nothing is changed.

    Args:
        config: The sidecar's settings.
        robot: Address of a robot, ``http://192.168.1.5``; ``None``: it is not looked for.
    """
    yield _versions()
    yield _disk(config)
    working = _sidecar(config)
    yield _store(config, working is not None)
    yield _token(config)
    yield from _camera_checks(config, working)
    yield from _world_model(config)
    yield _language_model(config)
    yield _notifications(config)
    yield _robot(robot) if robot else _clock()


def _versions() -> Examination:
    told = [f"aegis_ot {__version__}", f"Python {platform.python_version()}"]
    for name in _PACKAGES:
        try:
            told.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            told.append(f"{name} none")
    return Examination("versions", "ok", ", ".join(told))


def _disk(config: SidecarConfig) -> Examination:
    folder = next(p for p in (config.data, *config.data.parents) if p.exists())
    free = shutil.disk_usage(folder).free / 1e9
    said = f"{free:.1f} GB free for {config.data}"
    if free >= _LEAST_FREE_GB:
        return Examination("disk", "ok", said)
    return Examination("disk", "bad", said, "Free some space, or set retention.gigabytes.")


def _store(config: SidecarConfig, at_work: bool) -> Examination:
    if not (config.data / DATABASE).exists():
        return Examination("store", "ok", f"none yet in {config.data}; the sidecar makes it")
    try:
        store = Store(config.data, alone=True)
        count = len(store.runs())
        store.close()
    except StoreError as error:
        if at_work:
            return Examination("store", "ok", "in use by the sidecar that is at work")
        return Examination("store", "bad", str(error), "See above; until then no sidecar starts.")
    return Examination("store", "ok", f"whole, {count} runs")


def _token(config: SidecarConfig) -> Examination:
    if is_loopback(config.host):
        said = "not needed" if config.token is None else "set"
        todo = "For a robot in the network, start with --host 0.0.0.0; a token is then made."
        return Examination("token", "ok", f"{said}: only this machine is answered", todo)
    kept = (config.data / TOKEN_FILE).exists()
    return Examination(
        "token", "ok", "kept in the data folder" if kept else "set, or made at first start"
    )


def _sidecar(config: SidecarConfig) -> dict[str, Any] | None:
    """What a sidecar that is at work says of itself; ``None`` if there is none."""
    host = "127.0.0.1" if config.host in ("", "0.0.0.0", "::", "localhost") else config.host
    shown = f"[{host}]" if ":" in host else host
    try:
        with _DIRECT.open(f"http://{shown}:{config.port}/v1/health", timeout=2) as answer:
            said = json.loads(answer.read(10_000))
    except (OSError, ValueError):
        return None
    return said if isinstance(said, dict) and said.get("name") == "aegis-ot" else None


def _camera_checks(config: SidecarConfig, working: dict[str, Any] | None) -> Iterator[Examination]:
    if working is not None:
        camera = working.get("camera", {})
        state = "ok" if camera.get("ok") else "bad"
        said = f"{camera.get('kind')}, as the sidecar at work says: {camera.get('detail') or state}"
        yield Examination("camera", state, said, "" if state == "ok" else "See its page, Camera.")
        return
    for settings in config.cameras or (config.camera,):
        try:
            camera = open_camera(settings)
        except AegisError as error:
            yield Examination("camera", "bad", str(error), "Name another camera (--camera).")
            continue
        try:
            yield from _look(config, settings, camera)
        finally:
            camera.close()


def _look(config: SidecarConfig, settings: CameraSettings, camera: Camera) -> Iterator[Examination]:
    shown = without_secrets(settings.spec)
    try:
        if isinstance(camera, FreeRunning):
            yield _wait(camera, settings)
        view = Aim(config, camera, lambda: None).look()
    except CameraError as error:
        todo = "Look at its cable and power; close other programs that use it."
        yield Examination("camera", "bad", f"{shown}: {error}", todo)
        return
    except AegisError as error:
        yield Examination("detector", "bad", str(error), "Leave cascade.detector out, or mend it.")
        return
    height, width = view.frame.image.shape[:2]
    yield Examination("camera", "ok", f"{shown}, {width} x {height} px")
    light = (
        f"brightness {view.brightness:.0%}, too dark {view.dark:.0%}, blown out {view.blown:.0%}"
    )
    advice = [said for said in view.advice if said != "Good."]
    about_tip = [said for said in advice if "tip" in said and "focus" not in said]
    other = [said for said in advice if said not in about_tip]
    state = "warning" if other else "ok"
    yield Examination(
        "sharpness and light", state, f"sharpness {view.sharpness:.0f}, {light}", " ".join(other)
    )
    found = "no tip" if view.tip is None else f"a tip, {view.confidence:.0%} sure"
    state = "warning" if about_tip else "ok"
    yield Examination("detector", state, f"on a live frame: {found}", " ".join(about_tip))


def _wait(camera: FreeRunning, settings: CameraSettings) -> Examination:
    """What a keyframe costs: a frame counts when it was surely exposed after the trigger."""
    camera.frame_after(time.monotonic(), _FIRST_FRAME_S)  # it has only just been opened
    waits = []
    for _ in range(_WAITS):
        began = time.monotonic()
        camera.frame_after(began, _FIRST_FRAME_S)
        waits.append(time.monotonic() - began)
    name, longest = "camera's delay", max(waits)
    said = f"the robot stands up to {longest:.2f} s for each keyframe"
    if longest < _LONG_WAIT * settings.timeout_s:
        return Examination(name, "ok", said)
    todo = "Have it send more frames a second, or set camera.timeout_s higher."
    state = "warning" if longest < settings.timeout_s else "bad"
    return Examination(name, state, f"{said}, and a frame is given {settings.timeout_s:g} s", todo)


def _world_model(config: SidecarConfig) -> Iterator[Examination]:
    name, path = "world model", config.cascade.model
    if path is None and config.cascade.preset == "paper":
        yield Examination(name, "ok", "none: every run learns from its own first wells")
        return
    try:
        load_scorer(path or SHIPPED)
        model = load_model(path or SHIPPED)
    except AegisError as error:
        other = "Reinstall aegis_ot" if path is None else "Name another file in cascade.model"
        yield Examination(name, "bad", str(error), f"{other}; until then no sidecar starts.")
        return
    if path is None:
        said = "the shipped one, of simulated wells: what it would catch here is not known"
        yield Examination(
            name, "ok", said, "aegis-ot fit makes one of your own wells, which tells it."
        )
        return
    lacks = " ".join(shortcomings(model))
    said = f"{path}: {model.kind}, of {counted(normals_in(model), 'normal well')}"
    yield Examination(name, "warning" if lacks else "ok", said, lacks)
    yield from (_smallest(one) for one in smallest_in(model))
    yield from (Examination("own limits", "ok", said) for said in limits_in(model))


def _smallest(one: Smallest) -> Examination:
    if one.smallest_ul is None:
        todo = "Bring the camera closer, or dye the liquid."
        return Examination("smallest volume", "warning", str(one), todo)
    return Examination("smallest volume", "ok", str(one))


def _language_model(config: SidecarConfig) -> Examination:
    name, chosen = "language model", config.model.name
    if chosen is None:
        return Examination(name, "ok", "none is set: measured volumes and the operator decide")
    try:
        model = make_backend(chosen)
    except AegisError as error:
        return Examination(name, "bad", str(error), "Mend model.name.")
    problem = model.key_problem() if isinstance(model, ServiceBackend) else ""
    if problem:
        return Examination(name, "bad", f"{chosen} cannot be asked", problem)
    return Examination(name, "ok", f"{chosen} can be asked (it was not)")


def _notifications(config: SidecarConfig) -> Examination:
    urls = config.notifications.urls
    if not urls:
        todo = "Set notifications.urls to be told away from the bench."
        return Examination("notifications", "ok", "none are set", todo)
    try:
        Notifier(urls).close(0.1)
    except AegisError as error:
        return Examination("notifications", "bad", str(error), "Mend the address.")
    return Examination(
        "notifications", "ok", f"{len(urls)} addresses are understood (none was used)"
    )


def _robot(address: str) -> Examination:
    url = address.rstrip("/") if "://" in address else f"http://{address}"
    if url.count(":") < 2:
        url += ":32313" if url.startswith("https") else ":31950"
    request = urllib.request.Request(f"{url}/health", headers=load_settings().robot_headers())
    asked = time.time()
    try:
        with _DIRECT.open(request, timeout=5) as answer:
            said, date = json.loads(answer.read(100_000)), answer.headers.get("Date")
    except (OSError, ValueError) as error:
        todo = "See whether it is on, in this network, and whether the address is right."
        if isinstance(error, urllib.error.HTTPError) and error.code in (401, 403):
            todo = "Its access is controlled: give its token as AEGIS_OT_ROBOT_TOKEN."
        return Examination("robot", "bad", f"{url} does not answer: {error}", todo)
    told = (
        f"{said.get('name', '?')}, {said.get('robot_model', '?')}, {said.get('api_version', '?')}"
    )
    off = parsedate_to_datetime(date).timestamp() - asked if date else 0.0
    if abs(off) > _CLOCK_S:
        todo = "Set the clocks of robot and workstation by the network (NTP)."
        return Examination("robot", "warning", f"{told}; its clock is off by {off:.0f} s", todo)
    return Examination("robot", "ok", f"{told}; its clock agrees within {_CLOCK_S:g} s")


def _clock() -> Examination:
    now = time.strftime("%Y-%m-%d %H:%M:%S %Z")
    todo = "Compare it with the robot's: aegis-ot doctor --robot ADDRESS."
    return Examination("clock", "ok", now, todo)
