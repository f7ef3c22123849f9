"""A camera that shows what the simulated pipette would show.

It takes a real camera's place behind :class:`aegis_ot.vision.camera.Camera`. Its frames are
simulated: call every result on them so.
"""

from __future__ import annotations

import threading
import time
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from ..errors import CameraError, ConfigurationError
from ..vision.camera import Frame
from ..vision.tips import tip_for
from ..vocabulary import Keyframe, KeyframeKind
from .dyes import DYES, WATER, Dye, dye_for
from .exposure import decode
from .fault_plan import FaultPlan, PhysicalState
from .faults import Fault
from .render import render_jpeg
from .renderer import Renderer
from .scene import SceneState, TipContent, place_tip
from .session import SessionParameters
from .truth import FrameTruth

_READOUT_S = 0.005
"""From the start of an exposure to a frame in hand, where a frame rate is imitated, s."""


class SimulatedCamera:
    """Renders the tip at each announced keyframe, planted faults included.

    What a frame shows depends on ``seed`` and on the keyframe's run, sequence number and content
    only: a resent keyframe looks the same. Asked twice for the same keyframe without a new
    announcement, it gives a second exposure of the same scene.

    Args:
        seed: Fixes session and noise.
        faults: Planted faults, ``"partial:50@B3"`` or :class:`Fault`.
        parameters: Camera, light and deck; by default the measured webcam
            (:meth:`SessionParameters.webcam`), seen from the corner of the deck when the first
            keyframe is a multi-channel pipette's.
        reagent_colours: Liquids by reagent name, as :class:`Dye` or as the name of one
            (``{"sample": "red"}``), before the rules of :func:`~.dyes.dye_for`.
        rate: Frames per second to imitate a camera that runs freely; ``None``: a frame whenever
            one is asked for.
        render: Draws the frames.

    Raises:
        ConfigurationError: A fault or a colour cannot be used, or ``rate`` is not positive.
    """

    kind = "simulated"

    def __init__(
        self,
        seed: int = 0,
        faults: Iterable[Fault | str] = (),
        parameters: SessionParameters | None = None,
        reagent_colours: Mapping[str, Dye | str] | None = None,
        rate: float | None = None,
        render: Renderer = render_jpeg,
    ) -> None:
        if rate is not None and not rate > 0:
            raise ConfigurationError(
                f"The simulated camera's rate must be positive (frames per second), not {rate}."
            )
        self.seed = seed
        self._parameters = parameters
        self._colours = _colours(reagent_colours or {})
        self._rate = rate
        self._render = render
        film = (parameters or SessionParameters()).film
        self.plan = FaultPlan(faults, film)
        self._lock = threading.RLock()
        self._closed = threading.Event()
        self._keyframe: Keyframe | None = None
        self._state: PhysicalState | None = None
        self._exposures = 0
        self._started = time.monotonic()
        self._truth: FrameTruth | None = None

    @property
    def parameters(self) -> SessionParameters:
        """Camera, light and deck in use."""
        with self._lock:
            if self._parameters is None:
                self._parameters = SessionParameters.webcam(self.seed)
            return self._parameters

    @property
    def truth(self) -> FrameTruth | None:
        """What the latest frame truly shows; ``None`` before the first."""
        return self._truth

    def expect(self, keyframes: Iterable[Keyframe]) -> None:
        """Learn from a rehearsal which wells are to come (see :meth:`FaultPlan.expect`)."""
        with self._lock:
            self.plan.expect(keyframes)

    def announce(self, keyframe: Keyframe) -> None:
        """Put the pipette where this keyframe has it."""
        with self._lock:
            if self._parameters is None and 1 < keyframe.channels <= 8:
                self._parameters = SessionParameters.corner(self.seed)
            self._state = self.plan.apply(keyframe)
            self._keyframe = keyframe
            self._exposures = 0

    def frame_after(self, moment: float, timeout: float) -> Frame:
        """A frame whose exposure began at or after ``moment`` (``time.monotonic``, s).

        Before the first announcement it shows an idle pipette without a tip.

        Raises:
            CameraError: No such frame within ``timeout`` seconds, or the camera is closed.
        """
        begun = time.monotonic()
        exposed_at = self._next_exposure(max(moment, begun) if self._rate is None else moment)
        ready = exposed_at + (_READOUT_S if self._rate is not None else 0.0)
        if ready - begun > timeout:
            raise CameraError(
                f"The simulated camera has no frame exposed after the trigger within {timeout:g} s."
            )
        if self._closed.is_set():
            raise CameraError("The simulated camera is closed.")
        jpeg, truth = self._expose()
        if self._closed.wait(max(ready - time.monotonic(), 0.0)):
            raise CameraError("The simulated camera was closed while a frame was awaited.")
        self._truth = truth
        return Frame(jpeg=jpeg, image=decode(jpeg), exposed_at=exposed_at, simulated=True)

    def close(self) -> None:
        """Give no more frames; a waiting :meth:`frame_after` ends. Idempotent."""
        self._closed.set()

    def _next_exposure(self, moment: float) -> float:
        if self._rate is None:
            return moment
        ticks = np.ceil(max(moment - self._started, 0.0) * self._rate)
        return self._started + float(ticks) / self._rate

    def _expose(self) -> tuple[bytes, FrameTruth]:
        with self._lock:
            keyframe, exposure = self._keyframe, self._exposures
            self._exposures += 1
            scene = self._idle() if keyframe is None else self._scene(keyframe)
            run = zlib.crc32(keyframe.run.encode()) if keyframe else 0
            sequence = keyframe.sequence if keyframe else 0
            rng = np.random.default_rng((self.seed, run, max(sequence, 0), exposure))
            return self._render(scene, self.parameters, rng)

    def _idle(self) -> SceneState:
        missing = (TipContent(present=False),)
        return place_tip(self.parameters, KeyframeKind.POST_DISPENSE, tip_for("p1000"), missing)

    def _scene(self, keyframe: Keyframe) -> SceneState:
        assert self._state is not None
        contents = self._state.contents
        source = keyframe.sources[0].name if keyframe.sources else "A1"
        destination = keyframe.destinations[0].name if keyframe.destinations else source
        scene = place_tip(
            self.parameters,
            keyframe.kind,
            tip_for(keyframe.pipette, keyframe.capacity_ul),
            contents,
            dye_for(keyframe.reagent, self._colours),
            source=source,
            destination=destination,
        )
        return replace(scene, tip_name=keyframe.tip)


def _colours(given: Mapping[str, Dye | str]) -> dict[str, Dye]:
    colours = {}
    for reagent, dye in given.items():
        if isinstance(dye, str) and dye.lower() not in DYES:
            known = ", ".join(DYES)
            raise ConfigurationError(
                f"The colour {dye!r} of reagent {reagent!r} is not known. Use one of {known}."
            )
        colours[reagent] = dye if isinstance(dye, Dye) else DYES.get(dye.lower(), WATER)
    return colours
