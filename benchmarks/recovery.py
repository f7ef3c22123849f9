"""Runs with transient faults that the robot puts right by itself: how many need nobody, and whether
anything is contaminated by it.

``python -m benchmarks.recovery [--runs N] [--seed FIRST] [--json OUT]``

Each run is a whole dry run: the guard, a sidecar over a socket, simulated frames. One to three
faults are planted that strike only the first delivery into their well, in the second column of the
plate, when Layer 2 has calibrated. The same run without recovery is the comparison. A run that
needs a person goes on afterwards, as if that person had resumed it.

Layer 1 then judges what the robot really did, once as it happened (what a fault kept back is taken
out) and once as if every verdict of a failure had been wrong (then each recovery enters a well that
was served already). A new contamination is a finding of a rule about what tips carry that the
protocol without faults does not have. All results are simulated.
"""

from __future__ import annotations

import argparse
import json
import logging
import random
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from .recovery_protocols import CASES, RuleContext

RECOVER = {"no_aspirate": "retry", "no_dispense": "retry", "partial_dispense": "top_up"}
CARRY_RULES = (
    *("PCR-2", "PCR-3", "PCR-4", "PCR-5", "SD-2", "SD-5", "BRD-2", "BRD-3"),
    *("CELL-1", "CELL-3", "CELL-4", "GEN-1", "GEN-2"),
)
"""The rules about what tips carry, and about what must never get somewhere."""

KINDS = ("no_aspirate", "no_dispense", "partial:30", "partial:50", "partial:70")


@dataclass(frozen=True)
class Trial:
    """What came of one run.

    Attributes:
        case: Name of the protocol.
        faults: Planted.
        alone: Whether it ended without a person.
        alone_without: The same without recovery.
        recovered: Deliveries put right.
        missed: Planted faults that no verdict told, as long as no person was needed.
        why: Why a person was needed.
        contaminations: New findings, as it happened.
        contaminations_at_worst: New findings, had all verdicts been wrong.
        errors: What topped-up wells hold too much, as shares of their volume.
    """

    case: str
    faults: tuple[str, ...]
    alone: bool
    alone_without: bool
    recovered: int
    missed: int
    why: str
    contaminations: tuple[str, ...]
    contaminations_at_worst: tuple[str, ...]
    errors: tuple[float, ...]


def measure(count: int, first: int) -> Iterator[Trial]:
    """``count`` runs of each protocol."""
    for seed in range(first, first + count):
        for case in CASES:
            yield _trial(case, seed)


def _trial(case: RuleContext, seed: int) -> Trial:
    chance = random.Random(f"{case.name}{seed}")
    places = sorted(chance.sample(range(len(case.wells)), chance.randint(1, 3)))
    kinds = [chance.choice(KINDS) for _ in places]
    faults = tuple(
        f"{kind}@1:{case.wells[place]}x1" for kind, place in zip(kinds, places, strict=True)
    )
    without, _ = _run(case.text, faults, seed, {})
    result, heard = _run(case.text, faults, seed, RECOVER)
    alone = not result.flagged
    # A person who resumes does not empty the tip, and what is left in it hides later faults.
    first = next((n for n, row in enumerate(result.wells) if row.flagged), len(result.wells))
    failed = {row.address for row in result.wells if row.failure is not None}
    passed = {row.address for row in result.wells[:first]} - failed
    new, worst = _contaminations(case, faults, heard)
    return Trial(
        case.name, faults, alone, not without.flagged,
        sum(row.recovered for row in result.wells),
        sum(fault.split("@")[1].split("x")[0] in passed for fault in faults),
        _why(result), new, worst,
        tuple(_errors(faults, result.wells)),
    )  # fmt: skip


def _run(
    text: str, faults: Sequence[str], seed: int, recover: dict[str, str]
) -> tuple[Any, list[Any]]:
    """The dry run, and every operation that the simulated robot did."""
    from aegis_ot.adapters.opentrons.rehearsal import Recorder, Script
    from aegis_ot.dryrun import TRUSTING, DryRunProgress, DryRunSettings, dry_run
    from aegis_ot.sidecar import make_analyser

    recorder = Recorder()

    class Heard(DryRunProgress):
        def moves(self, operation: Any) -> None:
            recorder.after(operation)

    settings = DryRunSettings(
        tuple(faults), recover=recover, seed=seed, rules="off", cascade=TRUSTING
    )
    script = Script(text, "recovery.py")
    result = dry_run(script, settings, make_analyser(TRUSTING), Heard())
    return result, recorder.log


def _contaminations(
    case: RuleContext, faults: Sequence[str], steps: list[Any]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    from aegis_ot.adapters.opentrons.instrumentation import Event
    from aegis_ot.adapters.opentrons.rehearsal import Script, record
    from aegis_ot.preflight.check_protocol import check_recording
    from aegis_ot.settings import load_settings

    rehearsed = record(Script(case.text, "recovery.py"))
    # All that is loaded stands at the beginning of these protocols.
    loaded = [one for one in rehearsed.log if isinstance(one, Event)]
    settings = load_settings(assay=case.assay)

    def found(log: Sequence[Any]) -> set[str]:
        report = check_recording(replace(rehearsed, log=log), settings)
        return {
            f"{one.rule} {one.severity.value} {' '.join(sorted(w.address for w in one.wells))}"
            for one in report.findings
            if one.rule in CARRY_RULES
        }

    before = found(rehearsed.log)
    happened = found([*loaded, *_as_it_happened(steps, faults)]) - before
    return tuple(sorted(happened)), tuple(sorted(found([*loaded, *steps]) - before))


def _why(result: Any) -> str:
    """Why the first recovery was refused or failed, or what was flagged."""
    told = [
        one["text"]
        for one in result.reported.account["recoveries"]
        if one["state"] in ("refused", "failed")
    ]
    return "; ".join(told or [row.reason for row in result.flagged])


def _as_it_happened(steps: Sequence[Any], faults: Sequence[str]) -> list[Any]:
    """The steps with what each fault kept back taken out of its first delivery."""
    from aegis_ot.adapters.opentrons.instrumentation import OperationKind

    true = list(steps)
    for fault in faults:
        kind, _, place = fault.partition("@")
        well = place.split("x")[0]
        given = next(
            (
                number
                for number, step in enumerate(true)
                if step.kind is OperationKind.DISPENSE
                and not step.mixing
                and step.wells[0] is not None
                and step.wells[0].address == well
            ),
            None,
        )
        if given is None:
            continue  # the run ended before
        if kind == "no_aspirate":
            drawn = max(
                number
                for number in range(given)
                if true[number].kind is OperationKind.ASPIRATE and not true[number].air
            )
            true[drawn] = true[drawn]._replace(air=True)
        else:
            share = float(kind.partition(":")[2] or 0.0) / 100
            true[given] = true[given]._replace(volume=true[given].volume * share)
    return true


def _errors(faults: Sequence[str], rows: Sequence[Any]) -> Iterator[float]:
    """What a topped-up well was given over what it should have been, as a share."""
    for fault in faults:
        kind, _, place = fault.partition("@")
        well = place.split("x")[0]
        if not kind.startswith("partial"):
            continue
        failed = next((n for n, row in enumerate(rows) if row.address == well), None)
        if failed is None or not rows[failed].recovered or not rows[failed].failure:
            continue
        share = float(kind.partition(":")[2]) / 100
        volume, added = rows[failed].volume_ul, rows[failed + 1].volume_ul
        yield share + added / volume - 1


def show(trials: Sequence[Trial]) -> str:
    """As text."""
    lines = ["Runs with one to three transient faults; all frames and robots are simulated."]
    for name in (*dict.fromkeys(trial.case for trial in trials), "all"):
        some = [trial for trial in trials if name in (trial.case, "all")]
        alone = sum(trial.alone for trial in some)
        without = sum(trial.alone_without for trial in some)
        right = sum(trial.recovered for trial in some)
        missed = sum(trial.missed for trial in some)
        lines.append(
            f"{name}: {alone} of {len(some)} runs needed nobody ({without} without recovery), "
            f"{right} of {sum(len(trial.faults) for trial in some)} faults put right, "
            f"{missed} not seen before a person was needed."
        )
    errors = [error for trial in trials for error in trial.errors]
    if errors:
        largest = max(map(abs, errors))
        mean = sum(map(abs, errors)) / len(errors)
        lines.append(
            f"Topped-up wells: {len(errors)}, off by {mean:.1%} of their volume in the mean, "
            f"{largest:.1%} at most."
        )
    new = [one for trial in trials for one in trial.contaminations]
    worst = [one for trial in trials for one in trial.contaminations_at_worst]
    lines.append(f"New contaminations by Layer 1's rules: {len(new)}.")
    lines.append(f"The same, had every verdict of a failure been wrong: {len(worst)}.")
    lines += [f"  {one}" for one in (*new, *worst)]
    lines += [f"  {t.case}, {', '.join(t.faults)}: {t.why}" for t in trials if not t.alone]
    return "\n".join(lines)


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.recovery", description=__doc__)
    parser.add_argument("--runs", type=int, default=3, help="of each protocol")
    parser.add_argument("--seed", type=int, default=7000, help="the first one")
    parser.add_argument("--json", type=Path, help="write every run here")
    asked = parser.parse_args()
    logging.disable(logging.WARNING)  # Opentrons tells that no robot is calibrated here
    trials: list[Trial] = []
    for trial in measure(asked.runs, asked.seed):
        trials.append(trial)
        sys.stderr.write(f"{len(trials)} of {asked.runs * len(CASES)} runs\r")
    print(f"\n{show(trials)}")
    if asked.json is not None:
        told = {"frames": "simulated", "seed": asked.seed, "runs": [asdict(t) for t in trials]}
        asked.json.write_text(json.dumps(told, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
