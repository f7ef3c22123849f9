"""The report of a run that was started from the terminal: plain values, for a JSON file."""

from __future__ import annotations

from typing import Any

from .._version import __version__
from ..run_view import run_account
from ..vocabulary import to_json
from .running import RobotRun

FORMAT = "aegis-ot robot run"
VERSION = 1


def run_report(run: RobotRun) -> dict[str, Any]:
    """What happened on the robot, and what the sidecar saw of it.

    Returns:
        ``protocol``, ``robot``, ``url``, ``robot_run``; ``status``, ``errors``, ``seconds``,
        ``commands``, ``pauses``; ``analysis`` (``ok``, ``errors``, ``guard``: the guard's words);
        ``verdicts``, each with its ``state`` as it stands (``undecided`` where none came);
        ``unheard``: why verdicts may be missing; ``sidecar``: its account of the run, or
        ``None``.
    """
    analysis = run.analysis
    return {
        "format": FORMAT,
        "version": VERSION,
        "package": __version__,
        "protocol": run.protocol,
        "robot": run.robot,
        "url": run.url,
        "robot_run": run.id,
        "status": run.status,
        "errors": list(run.errors),
        "seconds": round(run.seconds, 1),
        "commands": run.commands,
        "pauses": run.pauses,
        "analysis": {
            "ok": analysis.ok,
            "errors": list(analysis.errors),
            "guard": list(analysis.guard_words),
        },
        "verdicts": [
            {"well": known.well, "state": known.state, **to_json(known.verdict)}
            for known in run.verdicts.values()
        ],
        "unheard": run.unheard,
        "sidecar": None if run.overview is None else run_account(run.overview),
    }
