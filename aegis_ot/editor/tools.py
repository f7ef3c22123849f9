"""What an agent may do: check, explain, simulate, look at runs, and start what passed Layer 1.

There is no tool that answers a question of the guard, releases a hold, or goes on after a pause:
that is for a person at the robot.
"""

from __future__ import annotations

import difflib
import json
import subprocess
import sys
import tempfile
import uuid
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError
from ..preflight import load_rules
from ..reports.check_json import protocol_values
from ..reports.rule_text import rule_text
from ..vocabulary import VerdictWord
from ..workbench.api import checked_protocol
from ..workbench.files import read_protocol
from ..workbench.given import known_rule
from ..workbench.mending import applied, mends_of
from .stdio import Tool

INSTRUCTIONS = (
    "aegis-ot guards Opentrons liquid handlers. Check a protocol before you call it done; an "
    "undecided rule says what to write. Roles of wells are facts of the laboratory: ask for "
    "them, do not guess. A pause of a run is answered by a person at the robot, never by you."
)

_TEXT: Mapping[str, Any] = {"type": "string"}
_TEXTS: Mapping[str, Any] = {"type": "array", "items": {"type": "string"}}
_PATH = {**_TEXT, "description": "Path of a Python protocol."}


def tools(data: Path | None, robots: Sequence[str]) -> list[Tool]:
    """All tools.

    Args:
        data: Data folder of the sidecar whose runs are shown; ``None``: its usual one.
        robots: Addresses of robots on which a run may be started; empty: none is started.
    """
    started = StartedRuns(robots)
    offered = [
        Tool(
            "check",
            "Rehearse a protocol in Opentrons' simulator and judge it by the assay rules. Gives "
            "verdict, findings with lines and fixes, undecided rules with what to write, and "
            "patches. Nothing reaches a robot.",
            {
                "path": _PATH,
                "text": {**_TEXT, "description": "Its text, if it is not saved as it stands."},
                "assay": _TEXTS,
                "select": _TEXTS,
                "ignore": _TEXTS,
                "strict": {"type": "boolean"},
            },
            ("path",),
            check,
        ),
        Tool("explain", "Say what a rule demands, why, and how to mend a violation.",
             {"rule": {**_TEXT, "description": "Identifier, as PCR-2."}}, ("rule",), explain),
        Tool("rules", "List every rule with what it demands.", {}, (), rules),
        Tool(
            "simulate",
            "Run a protocol with both layers on this machine, with planted faults, on simulated "
            "frames: which wells would be flagged, and where the run would pause.",
            {
                "path": _PATH,
                "faults": {**_TEXTS, "description": "As partial:50@B3, no_aspirate@C4, no_tip@E1."},
                "on_fail": {"enum": ["continue", "stop"]},
            },
            ("path",),
            simulate,
        ),
        Tool("runs", "List the runs that the sidecar has kept, newest first.",
             {"search": _TEXT, "most": {"type": "integer", "minimum": 1}}, (),
             lambda search="", most=20: kept_runs(data, search, most)),
        Tool("run", "Tell what came of one run, well by well; the newest if none is named.",
             {"run": _TEXT}, (), lambda run="": kept_run(data, run)),
    ]  # fmt: skip
    if robots:
        offered += [
            Tool(
                "start_run",
                "Start a protocol on a robot that the person has named. It is checked first and "
                "started only if Layer 1 passes it without a finding. The person at the robot "
                "answers every pause.",
                {"path": _PATH, "robot": {"enum": list(robots)}},
                ("path", "robot"),
                started.start,
                reads_only=False,
            ),
            Tool("started_run", "Tell how a run that was started here stands.",
                 {"id": _TEXT}, ("id",), started.state),
        ]  # fmt: skip
    return offered


def check(
    path: str,
    text: str | None = None,
    assay: Sequence[str] = (),
    select: Sequence[str] = (),
    ignore: Sequence[str] = (),
    strict: bool = False,
) -> dict[str, Any]:
    """The verdict as ``check --format json`` gives it, with patches as unified diffs."""
    given = {"assay": assay, "select": select, "ignore": ignore, "strict": strict}
    source, file = (Path(path), None) if text is None else (text, Path(path))
    checked = checked_protocol(source, file, given)
    told = protocol_values(checked, explain_roles=False)
    before = "\n".join(checked.lines) + "\n" if text is None else text
    if checked.report is not None and Path(path).suffix.lower() == ".py":
        told["mends"] = [
            {
                "title": mend.title,
                "rules": list(mend.rules),
                "line": mend.line,
                "sure": mend.sure,
                "patch": _patch(path, before, applied(before, mend.edits)),
            }
            for mend in mends_of(before, checked.report)
        ]
    return told


def _patch(name: str, before: str, after: str) -> str:
    lines = (before.splitlines(keepends=True), after.splitlines(keepends=True))
    return "".join(difflib.unified_diff(*lines, name, name))


def explain(rule: str) -> str:
    """All about one rule."""
    rule_set = load_rules(())
    return rule_text(*rule_set.rule(known_rule(rule, rule_set)))


def rules() -> list[dict[str, str]]:
    """Every rule."""
    return [
        {"id": rule.id, "name": rule.name, "family": family.family, "demands": rule.statement}
        for family in load_rules(()).families
        for rule in family.rules
    ]


def simulate(path: str, faults: Sequence[str] = (), on_fail: str = "continue") -> Any:
    """A dry run, in a process of its own: its protocol may do there what it likes."""
    asked = json.dumps({"path": path, "faults": list(faults), "on_fail": on_fail})
    done = subprocess.run(
        [sys.executable, "-m", "aegis_ot.editor.simulating"],
        input=asked, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode != 0:
        words = done.stderr.strip().splitlines() or ["The simulation ended without a word."]
        raise ConfigurationError(words[-1])
    return json.loads(done.stdout)


def kept_runs(data: Path | None, search: str, most: int) -> list[dict[str, Any]]:
    """Runs, each with how it ended and its wells by verdict."""
    from ..sidecar.overview import runs_overview

    rows = runs_overview(_store(data), search, most)
    names = ("run", "protocol", "robot", "simulated", "finished", "wells")
    return [{name: row.get(name) for name in names} for row in rows]


def kept_run(data: Path | None, run: str) -> dict[str, Any]:
    """One run's account."""
    from ..run_view import run_account
    from ..sidecar.overview import run_overview

    store = _store(data)
    known = [str(row["run"]) for row in store.runs()]
    if not known or (run and run not in known):
        raise ConfigurationError(f"{store.folder} holds no run {run!r}." if run else "No run yet.")
    account: dict[str, Any] = run_account(run_overview(store, run or known[0]))
    return account


def _store(data: Path | None) -> Any:
    from ..sidecar import SidecarConfig
    from ..sidecar.store.opening import open_store
    from ..sidecar.token_file import known_token

    return open_store(SidecarConfig.load(find_token=known_token).data if data is None else data)


class StartedRuns:
    """Runs that were started here, each followed by an ``aegis-ot run`` of its own."""

    def __init__(self, robots: Sequence[str]) -> None:
        self._robots = robots
        self._running: dict[str, tuple[subprocess.Popen[bytes], Path]] = {}

    def start(self, path: str, robot: str) -> dict[str, Any]:
        """Check a protocol, and start the very text that passed.

        Raises:
            ConfigurationError: The robot was not named by the person, or Layer 1 does not pass it.
        """
        if robot not in self._robots:
            raise ConfigurationError(f"No run may be started on {robot}: nobody has named it.")
        text = read_protocol(Path(path))
        checked = checked_protocol(text, Path(path))
        if checked.verdict is not VerdictWord.PASS:
            why = checked.problem.message if checked.problem else checked.verdict.value
            raise ConfigurationError(f"Nothing was started: Layer 1 does not pass {path} ({why}).")
        folder = Path(tempfile.mkdtemp(prefix="aegis-ot-run-"))
        judged, log = folder / Path(path).name, folder / "log.txt"
        judged.write_bytes(text.encode())
        with log.open("wb") as said:
            process = subprocess.Popen(
                [sys.executable, "-m", "aegis_ot", "run", str(judged), "--robot", robot, "--yes",
                 "--report", str(folder / "report.json")],
                stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT,
                start_new_session=True,  # the run goes on if the agent ends
            )  # fmt: skip
        name = uuid.uuid4().hex[:8]
        self._running[name] = process, log
        return {"id": name, "log": str(log), "undecided": [u.rule for u in checked.undecided]}

    def state(self, id: str) -> dict[str, Any]:
        """What ``aegis-ot run`` has said so far, and its exit code once it has ended."""
        if id not in self._running:
            raise ConfigurationError(f"No run {id!r} was started here.")
        process, log = self._running[id]
        return {
            "exit_code": process.poll(),
            "said": log.read_text(encoding="utf-8", errors="replace").splitlines()[-40:],
        }
