"""Several operating points judge the frames of one simulated run side by side."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.dryrun import TRUSTING, DryRunSettings, dry_run
from aegis_ot.llm import Backend, Reply, Request, State, load_prices
from aegis_ot.sidecar import Analyser, RunAnalysis, make_analyser
from aegis_ot.sidecar.analysers import make_detector
from aegis_ot.sidecar.config import CascadeSettings
from aegis_ot.vision.camera import Frame
from aegis_ot.vision.types import Detector, Image, TipDetection
from aegis_ot.vocabulary import Keyframe, Outcome, Route, Verdict

from ..tokens import request_size

CALIBRATION = 6

ALWAYS = "always-gate"

MODEL_POINTS = ("cascade, {}", "the paper's cascade, {}", "always-VLM, {}")
"""Operating points with a model, whose name goes into the braces."""


def plain_points(pca: Path) -> dict[str, CascadeSettings]:
    """Operating points without a model: the volumetric gate stands where the paper's model does.

    Args:
        pca: The paper's world model, fitted on earlier normals.
    """
    paper = TRUSTING.model_copy(update={"preset": "paper", "model": pca})
    return {
        "cascade": TRUSTING,
        "the paper's band": paper,
        ALWAYS: TRUSTING.model_copy(update={"always_gate": True}),
    }


def _model_point(form: str, pca: Path) -> CascadeSettings:
    if form == MODEL_POINTS[0]:
        return TRUSTING.model_copy(update={"gates": ("volumetric", "vlm")})
    paper = {"preset": "paper", "model": pca, "gates": ("vlm",), "spot_check": 0.0}
    return TRUSTING.model_copy(update=paper | {"always_gate": form == MODEL_POINTS[2]})


@dataclass(frozen=True)
class Word:
    """What one operating point said of one well.

    Attributes:
        well: Number of the well in its run, from 0.
        outcome, route: Of the verdict.
    """

    well: int
    outcome: Outcome
    route: Route

    @property
    def held(self) -> bool:
        """Whether the robot stops here: failed, or left to the operator."""
        return self.outcome is not Outcome.PASS

    @property
    def routed(self) -> bool:
        """Whether a gate was asked."""
        return self.route not in (Route.CALIBRATION, Route.SILENT_PASS)


class CountedModel:
    """Stands between an operating point and its model, if there is one, and counts.

    Attributes:
        name: The model's.
        tokens: Of each question, estimated.
        replies: What came of each.
    """

    def __init__(self, backend: Backend | None = None) -> None:
        self.name = "a model" if backend is None else backend.name
        self.tokens: list[int] = []
        self.replies: list[Reply] = []
        self._backend = backend

    def ask(self, request: Request) -> Reply:
        """As the backend does; without one, no answer: the well goes to the operator."""
        self.tokens.append(request_size(request).total)
        if self._backend is None:
            reply = Reply(State.NO_MODEL, self.name, detail="It is only counted.", attempts=0)
        else:
            reply = self._backend.ask(request)
        self.replies.append(reply)
        return reply

    @property
    def answered(self) -> bool:
        """Whether any question was."""
        return any(reply.answered for reply in self.replies)


def counted(backends: Sequence[Backend | None]) -> dict[str, CountedModel]:
    """A counter for each of :data:`MODEL_POINTS` and backend, by the point's name."""
    counters = [(form, CountedModel(one)) for one in backends for form in MODEL_POINTS]
    return {form.format(one.name): one for form, one in counters}


def analysers(
    pca: Path, points: Mapping[str, CascadeSettings], asking: Mapping[str, CountedModel]
) -> dict[str, Analyser]:
    """Operating points by name.

    Args:
        pca: The paper's world model.
        points: Those without a model.
        asking: Those with one, from :func:`counted`.
    """
    from aegis_ot.llm.gate_tiers import VlmTiers

    detector = _Remembering(make_detector())
    made = {name: make_analyser(one, detector=detector) for name, one in points.items()}
    for name, model in asking.items():
        form = next(one for one in MODEL_POINTS if one.format(model.name) == name)
        gates = {"vlm": VlmTiers([model], load_prices())}
        made[name] = make_analyser(_model_point(form, pca), gates, detector)
    return made


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
    dry_run(script, DryRunSettings(faults, seed=seed, rules="off"), jury)
    return jury.words


@dataclass
class _Jury:
    """An analyser that asks several, and answers with the first one's verdict."""

    inner: Mapping[str, Analyser]
    struck: int | None
    words: dict[str, list[Word]] = field(default_factory=dict)

    def begin(self, run: str, history: Sequence[Any] = ()) -> RunAnalysis:
        """As any analyser."""
        self.words = {name: [] for name in self.inner}
        return _JuryRun(self, {name: one.begin(run) for name, one in self.inner.items()})


@dataclass
class _JuryRun:
    jury: _Jury
    inner: Mapping[str, RunAnalysis]

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        for one in self.inner.values():
            one.observe(keyframe, frame)

    def judge(self, trajectory: int) -> tuple[Verdict, Mapping[str, Any]]:
        judged = {name: one.judge(trajectory) for name, one in self.inner.items()}
        for name, (verdict, _) in judged.items():
            self.jury.words[name].append(Word(trajectory, verdict.outcome, verdict.route))
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
