"""What the watcher says of a run, a verdict and a tip."""

from __future__ import annotations

import platform
import time
from collections.abc import Sequence
from pathlib import PurePath
from typing import Any

from .._version import __version__
from ..adapters.opentrons.instrumentation import Operation, OperationKind
from ..settings import Settings
from ..vocabulary import (
    ChannelOutcome,
    ChannelVerdict,
    Finding,
    Outcome,
    Verdict,
    one_line,
    with_places,
)

_MOST = 20
"""Findings that are told; the registration of a run has to stay small."""


def working_volume(operation: Operation) -> float | None:
    """Of the tip at an aspirate, µL; ``None`` if it cannot be asked."""
    if operation.kind is not OperationKind.ASPIRATE:
        return None
    try:
        return float(operation.core().get_hardware_state()["working_volume"])
    except Exception:  # private to Opentrons; the pipette's own maximum serves as well
        return None


def about_run(protocol: Any, run: str, file_name: str, simulating: bool) -> dict[str, Any]:
    """Body of the run's registration (``RunStart`` in the wire protocol)."""
    core = getattr(protocol, "_core", None)
    return {
        "run": run,
        "protocol": PurePath(file_name).name,
        "robot": str(getattr(core, "robot_type", "")),
        "robot_name": (platform.node() if simulating else _robot_name())[:200],
        "api_level": str(getattr(protocol, "api_version", "")),
        "simulated": simulating,
        "started": time.time(),
        "package": __version__,
    }


def _robot_name() -> str:
    """As the robot's own server and the App call it; the machine's name where that is not told."""
    try:
        from opentrons.config import name

        return str(name())
    except Exception:  # it asks the system, which may fail for a moment
        return platform.node()


def about_guard(settings: Settings) -> dict[str, Any]:
    """What the guard will do, for the page: its policies and its patience."""
    return {
        "hold": settings.hold,
        "on_fail": settings.on_fail,
        "on_undecided": settings.on_undecided,
        "on_link_loss": settings.on_link_loss,
        "verdict_timeout_s": settings.verdict_timeout_s,
        "recover": ", ".join(f"{kind}: {action}" for kind, action in settings.recover.items()),
    }


def about_layer1(report: Any, verdict: str = "", note: str = "") -> dict[str, Any]:
    """What Layer 1 found (an ``aegis_ot.preflight`` report), short enough for a registration.

    Args:
        report: ``None``: nothing was judged.
        verdict: Instead of the report's own, where it is not about the run as a whole.
        note: Why.
    """
    if report is None:
        return {"verdict": verdict, "note": note[:2000]}
    words = {} if not note else {"note": note[:2000]}
    return words | {
        "verdict": verdict or report.verdict.value,
        "findings": [_about_finding(finding) for finding in report.findings[:_MOST]],
        "more": max(0, len(report.findings) - _MOST),
        "undecided": [
            {"rule": one.rule, "reason": one_line(one.reason)} for one in report.undecided[:_MOST]
        ],
    }


def _about_finding(finding: Finding) -> dict[str, Any]:
    return {
        "rule": finding.rule,
        "severity": finding.severity.value,
        "message": one_line(finding.message, 500),
        "why": one_line(finding.why, 500),
        "fix": one_line(finding.fix, 500),
        "lines": list(finding.lines[:10]),
        "wells": [well.address for well in finding.wells[:10]],
    }


def tell_unobserved(channels: Sequence[ChannelVerdict]) -> str:
    """What is said once a run of tips that the camera cannot see."""
    return (
        f"The camera does not see the tips over {with_places(channels)}: other tips hide them. "
        "Wells of these channels are reported as unobserved, and nothing holds for them."
    )


def tell_verdict(place: str, verdict: Verdict) -> str:
    """One sentence for the operator."""
    what = {
        Outcome.PASS: "passed",
        Outcome.FAIL: "failed",
        Outcome.UNDECIDED: "could not be judged",
    }[verdict.outcome]
    bad = {Outcome.FAIL: ChannelOutcome.FAIL, Outcome.UNDECIDED: ChannelOutcome.UNDECIDED}
    those = [one for one in verdict.channels if one.outcome is bad.get(verdict.outcome)]
    if those:
        place = with_places(those)
    kind = f" ({verdict.failure.value.replace('_', ' ')})" if verdict.failure else ""
    reason = f": {verdict.reason.rstrip('.')}" if verdict.reason else ""
    return f"Delivery into {place} {what}{kind}{reason}."
