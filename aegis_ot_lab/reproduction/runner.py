"""Runs the experiments one after another; what is finished is kept, and taken up the next time."""

from __future__ import annotations

import json
import time
import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from aegis_ot.errors import AegisError, ConfigurationError

from .context import Context, as_json, version
from .experiment import Experiment, ExperimentOutcome


@dataclass(frozen=True)
class Entry:
    """One experiment of the page.

    Attributes:
        experiment: Which.
        outcome: What came of it; ``None`` if it was not run, or failed.
        problem: Why it failed.
        seconds: What it took, s.
        date: When it was run, local time.
        command: What gives it again.
        version: Of the package that ran it.
        seed: Of the run.
        taken_up: Whether it was finished before.
    """

    experiment: Experiment
    outcome: ExperimentOutcome | None = None
    problem: str = ""
    seconds: float = 0.0
    date: str = ""
    command: str = ""
    version: str = ""
    seed: int = 0
    taken_up: bool = False

    @property
    def state(self) -> str:
        """``done``, ``failed`` or ``not run``."""
        if self.outcome is not None:
            return "done"
        return "failed" if self.problem else "not run"

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return {
            "name": self.experiment.name,
            "title": self.experiment.title,
            "state": self.state,
            "problem": self.problem,
            "seconds": round(self.seconds, 1),
            "date": self.date,
            "command": self.command,
            "version": self.version,
            "seed": self.seed,
            "outcome": None if self.outcome is None else self.outcome.to_json(),
        }


def reproduce(
    experiments: Sequence[Experiment],
    chosen: Sequence[str],
    context: Context,
    told: Callable[[Entry], None],
    finished: Callable[[Sequence[Entry]], None],
) -> list[Entry]:
    """Run what is chosen and not finished. One that fails does not stop the others.

    Args:
        experiments: All there are.
        chosen: Names of those to run; of the others, what was kept is shown.
        context: What they run in.
        told: Told of each chosen experiment when it ends.
        finished: Told of all entries each time one was added: writes the page.

    Returns:
        One entry for each experiment, in order.
    """
    entries = {one.name: _kept(one, context) or Entry(one) for one in experiments}
    for experiment in experiments:
        if experiment.name not in chosen:
            continue
        if entries[experiment.name].outcome is None:
            entries[experiment.name] = _run(experiment, context)
            _keep(entries[experiment.name], context)
            finished(list(entries.values()))
        told(entries[experiment.name])
    finished(list(entries.values()))
    return list(entries.values())


def _run(experiment: Experiment, context: Context) -> Entry:
    begun = time.monotonic()
    outcome, problem = None, ""
    try:
        outcome = experiment.run(context)
    except AegisError as error:
        problem = str(error)
    except Exception as error:  # a broken experiment must not cost the others
        where = traceback.extract_tb(error.__traceback__)[-1]
        problem = (
            f"{type(error).__name__}: {error} ({Path(where.filename).name}, line {where.lineno}). "
            "This is a fault of the program; please report it."
        )
    return Entry(
        experiment,
        outcome,
        problem,
        time.monotonic() - begun,
        datetime.now().strftime("%Y-%m-%d %H:%M"),
        command(experiment, context),
        version(),
        context.options.seed,
    )


def command(experiment: Experiment, context: Context) -> str:
    """What runs an experiment again with the same options, but for the output folder."""
    options = context.options
    words = ["aegis-ot reproduce", f"--only {experiment.name}", f"--seed {options.seed}"]
    for name in experiment.uses:
        if name == "data":
            words += [f"--data {folder.name}" for folder in options.data]
        elif name == "models":
            words += [f"--model {model}" for model in options.models]
        else:
            words.append(f"--{name} {getattr(options, name)}")
    return " ".join([*words, "--out OUT"])


def key(experiment: Experiment, context: Context) -> dict[str, Any]:
    """What has to be equal for a kept result to be taken up."""
    options = {name: context.option(name) for name in experiment.uses}
    return {"version": version(), "seed": context.options.seed, "options": options}


def _file(experiment: Experiment, context: Context) -> Path:
    return context.options.out / "experiments" / f"{experiment.name}.json"


def _keep(entry: Entry, context: Context) -> None:
    """Only what was finished is kept: a failed one is tried again."""
    if entry.outcome is None:
        return
    path = _file(entry.experiment, context)
    unfinished = path.with_suffix(".unfinished")
    told = {"key": key(entry.experiment, context)} | entry.to_json()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished.write_text(as_json(told), encoding="utf-8")
        unfinished.replace(path)
    except OSError as error:
        raise ConfigurationError(f"{path} cannot be written: {error.strerror}.") from None


def _kept(experiment: Experiment, context: Context) -> Entry | None:
    """What was finished before with the same version, seed and options, pictures included."""
    try:
        kept: Mapping[str, Any] = json.loads(_file(experiment, context).read_text("utf-8"))
        if kept["key"] != key(experiment, context):
            return None
        outcome = ExperimentOutcome.from_json(kept["outcome"])
        told = {name: kept[name] for name in ("seconds", "date", "command", "version", "seed")}
    except (OSError, ValueError, KeyError, TypeError):
        return None
    if not all((context.options.out / one.file).is_file() for one in outcome.pictures):
        return None
    return Entry(experiment, outcome, **told, taken_up=True)
