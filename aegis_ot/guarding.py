"""What stands on a run from its first move to its last: tap, Layer 1 beside it, Layer 2 in it."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from contextvars import ContextVar
from types import MappingProxyType, TracebackType
from typing import TYPE_CHECKING, Any, NamedTuple

from .adapters.opentrons.instrumentation import NameCollector, Operation, Tap
from .known_tips import KnownTips
from .settings import Settings
from .vocabulary import one_line

if TYPE_CHECKING:
    from .adapters.opentrons.rehearsal import Recording, RunPlan
    from .followed_run import FollowedRun
    from .preflight.judging import Report
    from .runtime import Planner, RunControl, Watcher


AHEAD: ContextVar[Mapping[str, Any]] = ContextVar("aegis_ot_ahead", default=MappingProxyType({}))
"""Plates and deliveries of a rehearsal that whoever starts a simulated run has made already."""


class Layer1(NamedTuple):
    """What Layer 1 says before a run.

    Attributes:
        text: A line for the run log.
        report: The verdict on the rehearsal, if there is one.
        recording, plan: The rehearsal.
        unjudged: Why there is none; the run is judged as it comes.
        ahead: Plates and deliveries of the rehearsal, for the sidecar's page.
    """

    text: str
    report: Report | None = None
    recording: Recording | None = None
    plan: RunPlan | None = None
    unjudged: str = ""
    ahead: Mapping[str, Any] = MappingProxyType({})

    @classmethod
    def none(cls, why: str, settings: Settings) -> Layer1:
        """There is nothing to go by."""
        return cls("") if settings.rules == "off" else cls(why, unjudged=why)

    def words(self) -> dict[str, Any] | None:
        """The same for the sidecar's page."""
        from .followed_run import NOT_REHEARSED
        from .runtime import about_layer1

        if self.report is None and not self.unjudged:
            return None
        return about_layer1(self.report, NOT_REHEARSED if self.unjudged else "", self.unjudged)


class Guarding:
    """Both layers on one run. A ``with`` block around it, or :meth:`begin` and :meth:`end`.

    Args:
        protocol: The context.
        settings: In force.
        file_name: ``co_filename`` of the protocol's code.
        module: The protocol's globals.
        layer1: What Layer 1 said before.
        tips: What is gathered for recoveries.
    """

    def __init__(
        self,
        protocol: Any,
        settings: Settings,
        file_name: str,
        module: Mapping[str, Any],
        layer1: Layer1,
        tips: KnownTips | None,
    ) -> None:
        from .adapters.opentrons.rehearsal import Recorder

        self._protocol = protocol
        self._settings = settings
        self._file_name = file_name
        self._module = module
        self._layer1 = layer1
        self._watcher = new_watcher(protocol, settings, file_name, layer1, tips, module)
        self._recorder = tips.recorder if tips else Recorder()
        self._followed: FollowedRun | None = None
        self._taken_off = ExitStack()

    @property
    def moved(self) -> bool:
        """Whether any operation was seen."""
        return any(isinstance(one, Operation) for one in self._recorder.log)

    def begin(self) -> None:
        """Before the protocol's first command; raises what the watcher's ``begin`` raises."""
        from .runtime import Bystander

        watcher = self._watcher
        is_followed = bool(self._layer1.unjudged) or self._layer1.plan is not None
        if watcher is None and not is_followed:
            return
        hands = watcher or Bystander(self._protocol, self._settings, self._file_name)
        with ExitStack() as beginning:
            tap = Tap(self._protocol, [self._recorder, hands], self._file_name)
            beginning.callback(tap.remove)
            if is_followed:
                names = NameCollector(tap.wells, tap.stack, self._file_name)
                beginning.enter_context(names.gathering(self._module))
                self._followed = self._follow(tap, names, hands)
                tap.listen([self._recorder, self._followed, hands])
            tap.install()
            if watcher is not None:
                watcher.begin(tap)
            self._taken_off = beginning.pop_all()

    def _follow(self, tap: Tap, names: NameCollector, hands: RunControl) -> FollowedRun:
        from .adapters.opentrons.rehearsal import plain_values
        from .followed_run import FollowedRun
        from .preflight.live_judging import LiveJudge, RunKnowledge

        layer1 = self._layer1
        around = RunKnowledge(
            self._file_name,
            text_of(self._file_name, self._protocol),
            lambda: names.so_far(self._module),
            lambda: tap.wells.labware,
            plain_values(getattr(self._protocol, "_params", None)),
        )
        judge = LiveJudge(self._settings, around, self._recorder, layer1.recording, layer1.plan)
        return FollowedRun(judge, hands, self._settings, layer1.unjudged)

    def end(self, error: BaseException | None, told: str = "") -> None:
        """After its last, or when it raised ``error``; as the watcher's ``end``."""
        followed = self._followed
        try:
            if followed is not None:
                followed.end(error is None)
            if self._watcher is not None:
                self._watcher.end(error, told, followed.words() if followed else None)
        finally:
            self._taken_off.close()

    def say(self) -> None:
        """The closing comment."""
        text = self._followed.summary() if self._followed else ""
        say(self._protocol, text or self._layer1.text, self._watcher)

    def __enter__(self) -> Guarding:
        self.begin()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None
    ) -> None:
        self.end(error)


def new_watcher(
    protocol: Any,
    settings: Settings,
    file_name: str,
    layer1: Layer1 | None = None,
    tips: KnownTips | None = None,
    module: Mapping[str, Any] | None = None,
) -> Watcher | None:
    """Layer 2, where a sidecar is configured.

    In an analysis it only moves as it will in the live run, so that both show the Opentrons App
    the same sequence of commands.
    """
    if settings.sidecar is None:
        return None
    from .runtime import Watcher

    knowledge = None if tips is None else tips.knowledge
    words = None if layer1 is None else layer1.words()
    ahead = AHEAD.get() if layer1 is None or not layer1.ahead else layer1.ahead
    about = {"layer1": words, "title": _title(module or {}), **ahead}
    return Watcher(protocol, settings, file_name, about, knowledge, text_of(file_name, protocol))


def new_planner(plan: RunPlan) -> Planner:
    """Listens to a rehearsal beside its plan, for the sidecar's page."""
    from .runtime import Planner

    return Planner(lambda: plan.under)


def _title(module: Mapping[str, Any]) -> str:
    """What the protocol calls itself: ``metadata["protocolName"]``."""
    metadata = module.get("metadata")
    name = metadata.get("protocolName") if isinstance(metadata, Mapping) else None
    return one_line(name, 200) if isinstance(name, str) else ""


def text_of(file_name: str, protocol: Any) -> str:
    """The source of the protocol that is running, ``""`` where it cannot be had."""
    from .adapters.opentrons.rehearsal import find_script

    script = find_script(file_name, protocol)
    return script.text if script is not None else ""


def call_watched(call: Callable[[], Any], watcher: Watcher | None, tap: Tap) -> Any:
    """Call ``call()`` with Layer 2 around it, if there is one."""
    if watcher is None:
        return call()
    watcher.begin(tap)
    try:
        result = call()
    except BaseException as error:
        watcher.end(error)
        raise
    watcher.end(None)
    return result


def say(protocol: Any, layer1: str, watcher: Watcher | None) -> None:
    """One closing comment in analysis and live alike."""
    parts = [layer1] if layer1 else []
    if watcher is not None:
        parts.append(watcher.summary())
    if parts:
        protocol.comment(f"aegis_ot: {one_line(' '.join(parts), 4000)}")


# At the top level of a notebook's cell or of a program


_COVERED = {
    "block": "this guard covers what the `with` block does, with functions from elsewhere. ",
    "stack": "this guard goes on until its `with` block or stack is closed, in every cell. ",
    "again": "the earlier guard goes on; from now on it ends with this `with` block or stack. ",
}


def tell_what_is_covered(protocol: Any, settings: Settings, place: str) -> None:
    """What a guard covers that no function is around.

    Args:
        protocol: The context.
        settings: In force.
        place: ``"cell"``, ``"program"``, ``"block"``, ``"stack"`` or ``"again"``.
    """
    layer1 = (
        ""
        if settings.rules == "off"
        else (
            "Layer 1 has no run() to rehearse: it judges each step as it comes, and tells what it "
            "found at the end. "
        )
    )
    covered = f"this guard covers what follows in this {place} only, and ends with it. "
    text = _COVERED.get(place, covered) + layer1
    if place == "cell":
        text += (
            "What other cells do is not guarded. Write `with guard(protocol):` around calls of "
            "what other cells define; the docs, Notebooks, show how it lasts for several cells."
        )
    _tell(protocol, text.rstrip())


def tell_of_nothing(protocol: Any, place: str) -> str:
    """What is said of a guard at whose end nothing had moved."""
    text = (
        f"WARNING: the guard ended with its {place} and saw no pipetting: nothing was judged, "
        "nothing was watched."
    )
    _tell(protocol, text)
    return text


def place_of(file_name: str) -> str:
    """What stands around a top level: ``"program"``, or ``"cell"`` of a notebook."""
    return "program" if os.path.isfile(file_name) and "ipykernel" not in file_name else "cell"


def _tell(protocol: Any, text: str) -> None:
    protocol.comment(f"aegis_ot: {text}")
    print(f"aegis_ot: {text}", file=sys.stderr, flush=True)  # noqa: T201
