"""The project's own tip detector: a small heat-map network, run with onnxruntime."""

from __future__ import annotations

import copy
import functools
from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from ...errors import ModelError
from ..types import Axis, End, Ends, Image, TipDetection
from .decode import COLLAR, ORIFICE, Candidate, Maps, candidates, peaks
from .session import check_image, open_session, read_weights
from .views import CLOSE_UP_TIP, CLOSE_UP_TOP, View, close_up, overview, row_view, upright

FORMAT = "aegis-ot-tip-detector/1"
_SINGLE, _ROW = "tip_detector.onnx", "row_detector.onnx"
_GLANCE = 0.05  # score from which a candidate of the overview is looked at closely
_LOOKS = 3
_LEAST_HEAT = 0.05  # of an end of one of several tips
_RIVAL = 0.4
_AIM = 5.0  # px of the close-up by which the first aim may be off
_STRETCH = 0.05  # and the logarithm of its scale
_LEANS = 0.05  # of a tip's length: from here on a close-up of a known place is turned
_MULTIPLE = 16  # px, of which both sides of a view are multiples


def load_weights(
    path: str | Path | None = None, of_row: bool = False
) -> tuple[bytes, dict[str, Any]]:
    """Network and description of a detector made by ``aegis-ot train detector``.

    Args:
        path: The ``.onnx`` file; its description is the ``.json`` beside it. The shipped
            detector if not given.
        of_row: Of the shipped ones, that for the tips of a row.

    Raises:
        ModelError: A file is missing, damaged, or does not belong to the other.
    """
    folder = resources.files("aegis_ot.vision").joinpath("weights")
    name = _ROW if of_row else _SINGLE
    model = folder.joinpath(name) if path is None else Path(path)
    sidecar = (
        folder.joinpath(name.replace(".onnx", ".json"))
        if path is None
        else Path(path).with_suffix(".json")
    )
    remedy = "reinstall aegis_ot or train it anew with 'aegis-ot train detector'"
    return read_weights(model, sidecar, FORMAT, remedy)


class HeatmapDetector:
    """Finds the tip by two looks of one small network.

    The overview of the whole frame proposes up to three places; each is looked at again in a
    close-up, which measures the axis and decides. The confidence is the geometric mean of the
    heat of collar and orifice in the close-up and of the overview's score, weighted 3 to 1.

    Args:
        path: Weights made by ``aegis-ot train detector``, for both; the shipped ones if not given.
        threshold: Least confidence of a detection; the trained file's own if not given.
        threads: Threads that onnxruntime may use.

    Raises:
        ModelError: The weights are missing, damaged or of another version.
    """

    def __init__(
        self, path: str | Path | None = None, threshold: float | None = None, threads: int = 1
    ) -> None:
        weights, self.description = load_weights(path)
        own = self.description.get("threshold")
        if not isinstance(own, float | int) or not 0 <= own <= 1:
            raise ModelError(f"The tip detector's description has no usable threshold: {own!r}.")
        self.threshold = float(own) if threshold is None else threshold
        self._session = open_session(weights, threads, "The tip detector")
        if [each.name for each in self._session.get_inputs()] != ["image"]:
            raise ModelError("The tip detector's file is no network of this kind.")
        self._of_ends = self._session
        self._threads, self._is_shipped = threads, path is None

    @functools.cached_property
    def of_rows(self) -> HeatmapDetector | None:
        """The same with another network for the ends of a row's tips, trained on with rows in
        sight: it sees some that this one does not. ``None`` where weights are given.

        Raises:
            ModelError: Its file is missing or damaged.
        """
        if not self._is_shipped:
            return None
        other = copy.copy(self)
        weights, _ = load_weights(of_row=True)
        other._of_ends = open_session(weights, self._threads, "The detector of rows")
        return other

    def detect(self, image: Image) -> TipDetection | None:
        """The tip in a frame, ``None`` where there is none.

        Args:
            image: BGR, ``uint8``, shape ``(height, width, 3)``.

        Raises:
            ValueError: The image has another shape or type.
        """
        best = self.best_guess(image)
        return best if best is not None and best.confidence >= self.threshold else None

    def best_guess(self, image: Image) -> TipDetection | None:
        """The likeliest tip, however unlikely: what :meth:`detect` compares with its threshold."""
        check_image(image)
        first = overview(image)
        places = candidates(_maps(self._session, [first])[0], _GLANCE, _LOOKS)
        if not places:
            return None
        # A place much less likely than the best would not win in its close-up either.
        places = [place for place in places if place.score >= _RIVAL * places[0].score]
        views = [
            close_up(image, first.to_frame(*c.collar), first.to_frame(*c.orifice)) for c in places
        ]
        seen: list[tuple[Candidate, View, float]] = []
        for view, place, maps in zip(views, places, _maps(self._session, views), strict=True):
            seen += [(found, view, place.score) for found in candidates(maps, 0.01, 1)]
        if not seen:
            return None
        found, view, score = max(seen, key=lambda each: _confidence(each[0].score, each[2]))
        again = self._again(image, found, view)
        if again is not None and again[0].score >= found.score:
            found, view = again
        return _detection(found, view, score, image.shape[1], image.shape[0])

    def look_at(self, image: Image, axis: Axis) -> TipDetection | None:
        """The likeliest tip in a close-up of the place where one should hang, however unlikely.

        Args:
            image: BGR, ``uint8``, shape ``(height, width, 3)``.
            axis: Collar and orifice as they are expected, px.

        Raises:
            ValueError: The image has another shape or type.
        """
        check_image(image)
        (x0, _), (x1, _) = axis
        leans = abs(x1 - x0) > _LEANS * float(np.hypot(*np.subtract(*axis)))
        view = upright(image, *axis) if leans else close_up(image, *axis)
        found = next(iter(candidates(_maps(self._session, [view])[0], 0.01, 1)), None)
        if found is None:
            return None
        return _detection(found, view, found.score, image.shape[1], image.shape[0])

    def ends(self, image: Image, tip: TipDetection, reach: float) -> Ends:
        """All that looks like an end of a tip up to ``reach`` px beside ``tip``.

        For a row of tips: a close-up has one tip at its middle, and the vector of a tip's end
        goes astray where others stand near; the ends themselves are found apart.
        """
        return self._ends_in([row_view(image, tip.collar, tip.orifice, reach)])[0]

    def ends_of_length(self, image: Image, length: float) -> Ends:
        """All in the frame that looks like an end of a tip of about ``length`` px."""
        return self._ends_in([_whole(image, CLOSE_UP_TIP / length)])[0]

    def ends_of_each(self, image: Image, axes: Sequence[Axis]) -> list[Ends]:
        """What looks like an end in a close-up of each place: seen as single tips are.

        Args:
            image: BGR, ``uint8``, shape ``(height, width, 3)``.
            axes: Where a tip may hang, collar and orifice, px.
        """
        return self._ends_in([close_up(image, *axis) for axis in axes]) if axes else []

    def _ends_in(self, views: list[View]) -> list[Ends]:
        def found(view: View, maps: Maps, kind: int) -> tuple[End, ...]:
            return tuple(
                End(*view.to_frame(x, y), heat) for x, y, heat in peaks(maps, kind, _LEAST_HEAT)
            )

        return [
            Ends(found(view, maps, COLLAR), found(view, maps, ORIFICE))
            for view, maps in zip(views, _maps(self._of_ends, views), strict=True)
        ]

    def _again(self, image: Image, found: Candidate, view: View) -> tuple[Candidate, View] | None:
        """A second close-up, aimed with the first one, where the first was aimed badly."""
        collar, orifice = view.to_frame(*found.collar), view.to_frame(*found.orifice)
        better = close_up(image, collar, orifice)
        aim = better.from_frame(*view.to_frame(view.image.shape[1] / 2, CLOSE_UP_TOP))
        off = np.hypot(aim[0] - better.image.shape[1] / 2, aim[1] - CLOSE_UP_TOP)
        stretch = abs(np.log(better.scale_y / view.scale_y))
        if off < _AIM and stretch < _STRETCH:
            return None
        (maps,) = _maps(self._session, [better])
        return next(((each, better) for each in candidates(maps, 0.01, 1)), None)


def _maps(session: Any, views: list[View]) -> NDArray[np.float32]:
    batch = np.stack([view.image for view in views])
    maps: NDArray[np.float32] = session.run(None, {"image": batch})[0]
    return maps


def _whole(image: Image, scale: float) -> View:
    """The whole frame at a scale, padded with black on the right and below."""
    rows, columns = image.shape[:2]
    w, h = max(2, round(columns * scale)), max(2, round(rows * scale))
    mode = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
    canvas = np.zeros((-(-h // _MULTIPLE) * _MULTIPLE, -(-w // _MULTIPLE) * _MULTIPLE, 3), np.uint8)
    canvas[:h, :w] = cv2.resize(image, (w, h), interpolation=mode)
    return View(canvas, w / columns, h / rows, 0.0, 0.0)


def _confidence(close_up_score: float, overview_score: float) -> float:
    return float(min(1.0, close_up_score**0.75 * overview_score**0.25))


def _detection(
    seen: Candidate, view: View, overview_score: float, width: int, height: int
) -> TipDetection:
    collar, orifice = view.to_frame(*seen.collar), view.to_frame(*seen.orifice)
    radius = seen.radius / view.scale_x
    left = max(0.0, min(collar[0], orifice[0]) - radius)
    right = min(float(width), max(collar[0], orifice[0]) + radius)
    top, bottom = max(0.0, collar[1]), min(float(height), orifice[1])
    confidence = _confidence(seen.score, overview_score)
    return TipDetection(
        left, top, max(0.0, right - left), max(0.0, bottom - top), confidence, orifice, collar
    )
