"""What the watcher says of a run, a verdict and a tip."""

from __future__ import annotations

import time
from pathlib import PurePath
from typing import Any

from .._version import __version__
from ..instrumentation import Operation, OperationKind
from ..vocabulary import Outcome, Verdict


def working_volume(operation: Operation) -> float | None:
    """Of the tip at an aspirate, µL; ``None`` if it cannot be asked."""
    if operation.kind is not OperationKind.ASPIRATE or operation.core is None:
        return None
    try:
        return float(operation.core.get_hardware_state()["working_volume"])
    except Exception:  # private to Opentrons; the pipette's own maximum serves as well
        return None


def about_run(protocol: Any, run: str, file_name: str, simulating: bool) -> dict[str, Any]:
    """Body of the run's registration (``RunStart`` in the wire protocol)."""
    core = getattr(protocol, "_core", None)
    return {
        "run": run,
        "protocol": PurePath(file_name).name,
        "robot": str(getattr(core, "robot_type", "")),
        "api_level": str(getattr(protocol, "api_version", "")),
        "simulated": simulating,
        "started": time.time(),
        "package": __version__,
    }


def tell_verdict(place: str, verdict: Verdict) -> str:
    """One sentence for the operator."""
    what = {
        Outcome.PASS: "passed",
        Outcome.FAIL: "failed",
        Outcome.UNDECIDED: "could not be judged",
    }[verdict.outcome]
    kind = f" ({verdict.failure.value.replace('_', ' ')})" if verdict.failure else ""
    reason = f": {verdict.reason.rstrip('.')}" if verdict.reason else ""
    return f"Delivery into {place} {what}{kind}{reason}."
