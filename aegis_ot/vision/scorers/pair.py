"""A tip before and after its dispense, compared by a network with the run's own normal wells.

The network has learned from drawn and path-traced tips before cameras of all kinds
(``scripts/pair_network``), and nothing from any laboratory: what this camera's tips look like it is
shown each time, as the mean of the run's normal pairs.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from functools import lru_cache
from importlib import resources
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ModelError
from ...vocabulary import KeyframeKind
from ..column.alone import alone
from ..column.measure import shape_of
from ..detection.session import open_session, read_weights
from ..models import ModelFile
from ..types import FREE, TrajectorySample
from .looks import hang_alike, looks
from .pair_strips import half_widths, strip_of, wet_rows
from .surprise import NO_TIP, Tail, fit_tail

FORMAT = "aegis-ot-pair-network/1"

_PRIOR = Tail(0.0, 0.7)
"""Log odds at which something is as likely wrong as not."""

_REFERENCES = 3
"""Normal wells of its plate with which a normal well of a fit is compared, as in a run."""

_HELD_BACK = 0.05
"""Share of the drawn volume that may be meant to stay in the tip: the network knows tips that are
emptied."""

Array = NDArray[np.float32]


class Pair(NamedTuple):
    """Both free frames of a trajectory, cut out along the tip.

    Attributes:
        frames: ``(2, ROWS, COLUMNS, 3)``, BGR, 0 to 1.
        liquid: ``(ROWS,)``: 1 where liquid should stand in TRANSIT.
        half_width: ``(ROWS,)``: of the tip, as a share of the strip's half width.
    """

    frames: Array
    liquid: Array
    half_width: Array


class PairReading(NamedTuple):
    """What the network says.

    Attributes:
        wrong: Log odds that something is.
        kept: Log odds that a part of the liquid stayed: of half of it at 0.
        wet: ``(2, ROWS)``: log odds that liquid stands in a row, in both frames.
    """

    wrong: float
    kept: float
    wet: Array


@lru_cache(maxsize=1)
def _network() -> Any:
    folder = resources.files("aegis_ot.vision").joinpath("weights")
    name = "pair_network.onnx"
    weights, _ = read_weights(folder.joinpath(name), folder.joinpath("pair_network.json"), FORMAT)
    return open_session(weights, 1, "The pair network")


def pair_of(sample: TrajectorySample) -> Pair | None:
    """The pair of a trajectory; ``None`` where a frame is missing or does not show the tip, where
    the tip hangs at two places, and where liquid is meant to stay in it. Cut once per sample: it
    outlives the frames."""
    return sample.once("pair", lambda: _pair_of(sample))


def _pair_of(sample: TrajectorySample) -> Pair | None:
    seen = looks(sample)
    full, kept = (sample.expected_ul.get(kind, 0.0) for kind in FREE)
    if not all(kind in seen and kind in sample.frames for kind in FREE):
        return None
    if full <= 0 or kept > _HELD_BACK * full:
        return None
    if not hang_alike(sample.detections, sample.positions):
        return None
    frames = np.stack([_strip(sample, kind) for kind in FREE]).astype(np.float32) / 255.0
    return Pair(frames, wet_rows(sample.tip, ((0.0, full),)), half_widths(sample.tip))


def _strip(sample: TrajectorySample, kind: KeyframeKind) -> NDArray[np.uint8]:
    """Of one frame; the neighbours of a row's tip are painted over."""
    image, seen, detection = sample.frames[kind], looks(sample)[kind], sample.detections[kind]
    corner = (0, 0)
    if detection is not None and detection.apart is not None:
        image, _, corner = alone(image, detection, shape_of(sample.tip))
    collar, orifice = (np.subtract(end, corner) for end in (seen.collar, seen.orifice))
    return strip_of(image, collar, orifice, sample.tip)


def read_pair(pair: Pair, normals: Sequence[Pair] = ()) -> PairReading:
    """Compare a pair with normal ones; without any, read it by itself.

    Raises:
        ModelError: The network's file is missing or damaged.
    """
    known = list(normals) or [pair]
    flag = np.float32(bool(normals))
    usual = np.mean([one.frames for one in known], axis=0)
    liquid = flag * np.mean([one.liquid for one in known], axis=0)
    given = {
        "own": pair.frames[None],
        "usual": usual[None],
        "known": np.array([flag]),
        "tip": np.stack([pair.liquid, pair.half_width, liquid]).astype(np.float32)[None],
    }
    wet, odds = _network().run(["wet", "odds"], given)
    return PairReading(float(odds[0, 0]), float(odds[0, 1]), wet[0])


def surprise_of(reading: PairReading, known: NDArray[np.float64]) -> float:
    """How unusual a reading is among the log odds of normals, nats."""
    return fit_tail(known.tolist(), _PRIOR).surprise(reading.wrong)


class PairScorer:
    """Surprise of what the network says among the normals of a fit, nats.

    Attributes:
        known: Log odds of a fit's normals, each compared with others of its plate, by class of tip.
    """

    name = "pair"

    def __init__(self) -> None:
        self.known: dict[str, NDArray[np.float64]] = {}
        self._normals: list[Pair] = []

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        """Learn what the network says of normals, read as in use.

        Raises:
            ValueError: On an empty sequence.
        """
        if not normals:
            raise ValueError("no normal trajectories to learn from")
        plates: dict[tuple[str, str], list[Pair]] = defaultdict(list)
        for sample in normals:
            pair = pair_of(sample)
            if pair is not None:
                plates[sample.tip_class, sample.plate].append(pair)
        odds: dict[str, list[float]] = defaultdict(list)
        for (name, _), pairs in plates.items():
            for at, pair in enumerate(pairs):
                others = [*pairs[at + 1 :], *pairs[:at]][:_REFERENCES]
                odds[name].append(read_pair(pair, others).wrong)
        self.known = {name: np.sort(values) for name, values in odds.items()}
        self._normals = []

    def calibrate(self, normals: Sequence[TrajectorySample]) -> None:
        """Compare what comes with a run's own normal wells."""
        self._normals = [pair for pair in map(pair_of, normals) if pair is not None]

    def score(self, sample: TrajectorySample) -> float:
        """Surprise of one trajectory, nats, >= 0; 0 where it has no pair."""
        if sample.lacks_tip:
            return NO_TIP
        reading = self.read(sample)
        return 0.0 if reading is None else surprise_of(reading, self.normals_like(sample))

    def normals_like(self, sample: TrajectorySample) -> NDArray[np.float64]:
        """Log odds of the fit's normals with such a tip; of all where it had none, for the network
        knows no tip by its name."""
        known = self.known.get(sample.learned_as(self.known))
        return np.sort(np.concatenate([*self.known.values(), []])) if known is None else known

    def read(self, sample: TrajectorySample) -> PairReading | None:
        """What the network says of a trajectory, compared with the run's normal wells."""
        pair = pair_of(sample)
        return None if pair is None else read_pair(pair, self._normals)

    def to_arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Arrays and settings for a model file."""
        return dict(self.known), {"pipettes": list(self.known)}

    @classmethod
    def from_model(cls, model: ModelFile) -> PairScorer:
        """A scorer from a model file.

        Raises:
            ModelError: If arrays are missing or their shapes do not fit, or the network's file is
                missing or damaged: a run says so before its first well.
        """
        _network()
        scorer = cls()
        try:
            scorer.known = {
                str(name): np.sort(np.asarray(model.arrays[name], dtype=float).ravel())
                for name in model.settings["pipettes"]
            }
        except (KeyError, TypeError, ValueError) as error:
            raise ModelError(f"the pair model lacks or garbles {error}; fit it anew") from error
        return scorer
