"""Several operating points judge the frames of one simulated run side by side."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ...dryrun.runner import DryRunSettings, dry_run
from ...preflight.rehearsal import Script
from ...reasoning import Backend, Reply, Request, load_prices
from ...sidecar import Analyser, RunAnalyser, make_analyser
from ...sidecar.config import CascadeSettings
from ...sidecar.judging import make_detector
from ...vision.camera import Frame
from ...vision.types import Detector, Image, TipDetection
from ...vocabulary import Gate, Keyframe, Outcome, Route, Verdict

CALIBRATION = 6

POINTS: dict[str, CascadeSettings] = {
    "cascade": CascadeSettings(first_wells="trust"),
    "the paper's band": CascadeSettings(first_wells="trust", preset="paper"),
    "always-gate": CascadeSettings(first_wells="trust", always_gate=True),
}
"""Operating points without a model: the volumetric gate stands where the paper's model does.

The paper's band: PCA of the run's own first wells, median ± 0.7·MAD."""

MODEL_POINTS: dict[str, CascadeSettings] = {
    "cascade, {}": CascadeSettings(first_wells="trust", gates=("volumetric", "vlm")),
    "the paper's cascade, {}": CascadeSettings(
        first_wells="trust", preset="paper", gates=("vlm",), spot_check=0.0
    ),
    "always-VLM, {}": CascadeSettings(
        first_wells="trust", preset="paper", gates=("vlm",), always_gate=True
    ),
}
"""Operating points with a model, by its name."""


@dataclass(frozen=True)
class Word:
    """What one operating point said of one well.

    Attributes:
        well: Number of the well in its run, from 0.
        outcome, route, gate: Of the verdict.
        costs: Of asking models: ``calls``, ``tokens_in``, ``amount``, ``seconds`` and the like.
    """

    well: int
    outcome: Outcome
    route: Route
    gate: Gate
    costs: tuple[Mapping[str, Any], ...] = ()

    @property
    def held(self) -> bool:
        """Whether the robot stops here: failed, or left to the operator."""
        return self.outcome is not Outcome.PASS

    @property
    def routed(self) -> bool:
        """Whether a gate was asked."""
        return self.route not in (Route.CALIBRATION, Route.SILENT_PASS)


class Heard:
    """A backend, and whether it ever answered."""

    def __init__(self, backend: Backend) -> None:
        self.name = backend.name
        self.answered = 0
        self._backend = backend

    def ask(self, request: Request) -> Reply:
        """As the backend does."""
        reply = self._backend.ask(request)
        self.answered += reply.answered
        return reply


def analysers(
    points: Mapping[str, CascadeSettings], model_points: Mapping[str, Backend]
) -> dict[str, Analyser]:
    """Operating points by name.

    Args:
        points: Those without a model.
        model_points: Models by the name of one of :data:`MODEL_POINTS`, with its model's name in.
    """
    from ...reasoning.gate_tiers import VlmTiers

    detector = _Remembering(make_detector())
    made = {name: make_analyser(one, detector=detector) for name, one in points.items()}
    for name, backend in model_points.items():
        settings = next(
            one for form, one in MODEL_POINTS.items() if form.format(backend.name) == name
        )
        gates = {"vlm": VlmTiers([backend], load_prices())}
        made[name] = make_analyser(settings, gates, detector)
    return made


def points_of(backends: Sequence[Backend]) -> dict[str, Backend]:
    """All of :data:`MODEL_POINTS` for each backend."""
    return {form.format(one.name): one for one in backends for form in MODEL_POINTS}


def judged_run(
    script: Script, seed: int, analysers_: Mapping[str, Analyser], struck: int | None = None,
    fault: str = "",
) -> dict[str, list[Word]]:  # fmt: skip
    """What each operating point says of each well of one run of the simulated robot.

    The robot goes on whatever is said, so that all points judge the same frames. An operator
    finds sound wells right that a point leaves to him.

    Args:
        script: The protocol.
        seed: Of the camera.
        analysers_: Operating points by name.
        struck: Number of the well with the fault, from 0; ``None``: all are sound.
        fault: What is planted there, ``"partial:50"``.
    """
    jury = _Jury(analysers_, struck)
    faults = () if struck is None else (f"{fault}@#{struck + 1}",)
    cascade = POINTS["cascade"]
    dry_run(script, DryRunSettings(faults, seed=seed, rules="off", cascade=cascade), jury)
    return jury.words


@dataclass
class _Jury:
    """An analyser that asks several, and answers with the first one's verdict."""

    inner: Mapping[str, Analyser]
    struck: int | None
    words: dict[str, list[Word]] = field(default_factory=dict)

    def begin(self, run: str, history: Sequence[Any] = ()) -> RunAnalyser:
        """As any analyser."""
        self.words = {name: [] for name in self.inner}
        return _JuryRun(self, {name: one.begin(run) for name, one in self.inner.items()})


@dataclass
class _JuryRun:
    jury: _Jury
    inner: Mapping[str, RunAnalyser]

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        for one in self.inner.values():
            one.observe(keyframe, frame)

    def judge(self, trajectory: int) -> tuple[Verdict, Mapping[str, Any]]:
        judged = {name: one.judge(trajectory) for name, one in self.inner.items()}
        for name, (verdict, evidence) in judged.items():
            costs = tuple(evidence.get("costs") or ())
            self.jury.words[name].append(
                Word(trajectory, verdict.outcome, verdict.route, verdict.gate, costs)
            )
            if verdict.outcome is Outcome.UNDECIDED and trajectory != self.jury.struck:
                self.inner[name].confirm(trajectory)
        return next(iter(judged.values()))

    def confirm(self, trajectory: int) -> None:
        """Each point was told already."""


class _Remembering:
    """A detector that looks at each frame once, however many points ask."""

    MOST = 64

    def __init__(self, detector: Detector) -> None:
        self._detector = detector
        self.name = getattr(detector, "name", "detector")
        self._found: OrderedDict[tuple[str, int], tuple[Image, Any]] = OrderedDict()
        if hasattr(detector, "best_guess"):
            self.best_guess = lambda image: self._once("best_guess", image)

    def detect(self, image: Image) -> TipDetection | None:
        found: TipDetection | None = self._once("detect", image)
        return found

    def _once(self, how: str, image: Image) -> Any:
        key = how, id(image)
        if key not in self._found:
            self._found[key] = image, getattr(self._detector, how)(image)
            while len(self._found) > self.MOST:
                self._found.popitem(last=False)
        return self._found[key][1]


def after_calibration(words: Sequence[Word]) -> Iterator[Word]:
    """Those wells on which the run is not calibrated."""
    return (word for word in words if word.well >= CALIBRATION)
