"""How well a run's camera is known, which of its tips it sees, and when it was moved."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np

from ..errors import ConfigurationError, StoreError
from ..sidecar.store import Store
from ..vision.registration import Registration, TipLocator
from ..vision.tips import tip_for
from ..vision.types import FREE, Detector, Image
from ..vocabulary import Keyframe, WellRef


@dataclass(frozen=True)
class TipInView:
    """One place at which the run held a tip.

    Attributes:
        well: Under or around the tip.
        error_px: Standard error of where the tip is projected.
        lacking: ``"upper end"``, ``"lower end"``, ``"tip"``, or empty if all of it is in view.
    """

    well: WellRef
    error_px: float
    lacking: str


@dataclass(frozen=True)
class CameraCheck:
    """What a run's keyframes and frames say of its camera.

    Attributes:
        keyframes: How many of them had a position and a readable frame.
        registration: The camera as it stood at the end; ``None``: it could not be registered.
        places: Each place at which the run held a tip above a well, once.
        moved: Wells at which it was found to have been moved.
    """

    keyframes: int
    registration: Registration | None
    places: tuple[TipInView, ...]
    moved: tuple[WellRef, ...]

    @property
    def error_px(self) -> float:
        """Standard error that 95 % of the places stay below, px."""
        return float(np.percentile([place.error_px for place in self.places], 95))

    @property
    def is_sound(self) -> bool:
        """Whether the camera is known, stood still, and sees every tip whole."""
        lacking = any(place.lacking for place in self.places)
        return self.registration is not None and not lacking and not self.moved


def check_camera(store: Store, run: str, detector: Detector) -> CameraCheck:
    """Register a kept run's camera anew.

    Raises:
        ConfigurationError: The run's frames are drawn or replayed, or no keyframe of a single tip
            has a position.
        StoreError: The store cannot be read.
    """
    if (store.run(run) or {}).get("simulated"):
        raise ConfigurationError(
            f"The frames of run {run!r} are drawn or replayed: they say nothing of a camera."
        )
    keyframes = [captured.keyframe for captured in store.keyframes(run)]
    usable = [k for k in keyframes if k.position is not None and k.channels == 1 and not k.late]
    if not usable:
        raise ConfigurationError(
            f"No keyframe of run {run!r} says where a single tip is on the deck, so its camera "
            "cannot be registered. Guarded runs say it; rows of tips and watched runs "
            "without coordinates do not serve."
        )
    return camera_from(_frames(store, usable), detector)


def camera_from(frames: Iterable[tuple[Keyframe, Image]], detector: Detector) -> CameraCheck:
    """The same from keyframes with positions, in order, and their frames."""
    locator = TipLocator(detector)
    moved: list[WellRef] = []
    places: dict[tuple[str, tuple[float, ...]], Keyframe] = {}
    count, size = 0, (0, 0)
    for keyframe, image in frames:
        assert keyframe.position is not None
        count, size, before = count + 1, (image.shape[1], image.shape[0]), locator.times_moved
        tip = tip_for(keyframe.pipette, keyframe.capacity_ul).name
        locator.locate(image, keyframe.position, tip, keyframe.kind not in FREE)
        well = _well(keyframe)
        if well is not None and locator.times_moved > before:
            moved.append(well)
        if well is not None and keyframe.kind in FREE:
            places.setdefault((well.address, keyframe.position), keyframe)
    known = locator.registration if locator.is_registered else None
    seen = [] if known is None else [_in_view(known, each, size) for each in places.values()]
    found = tuple(place for place in seen if place is not None)
    return CameraCheck(count, known if found else None, found, tuple(moved))


def _frames(store: Store, keyframes: Iterable[Keyframe]) -> Iterable[tuple[Keyframe, Image]]:
    for keyframe in keyframes:
        try:
            jpeg = store.frame(keyframe.run, keyframe.sequence)
        except StoreError:
            continue
        image = (
            cv2.imdecode(np.frombuffer(jpeg or b"", np.uint8), cv2.IMREAD_COLOR) if jpeg else None
        )
        if image is not None:
            yield keyframe, np.asarray(image, np.uint8)


def _in_view(known: Registration, keyframe: Keyframe, size: tuple[int, int]) -> TipInView | None:
    assert keyframe.position is not None
    tip = tip_for(keyframe.pipette, keyframe.capacity_ul).name
    there, well = known.project_tip(keyframe.position, tip), _well(keyframe)
    if there is None or well is None:
        return None
    return TipInView(well, there.sigma_px, there.lacking(size))


def _well(keyframe: Keyframe) -> WellRef | None:
    """The well at which a keyframe was taken."""
    at_source = keyframe.kind.value in ("aspirate", "transit")
    wells = keyframe.sources if at_source else keyframe.destinations
    return wells[0] if wells else None
