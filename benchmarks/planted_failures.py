"""What a failed tip touches before the robot stands still: nothing, it should be.

``python -m benchmarks.planted_failures [--count 200] [--seed FIRST] [--json OUT]``

Each failure is a whole dry run that ends at the first hold which is not a pass: the guard, a
sidecar over a socket, simulated frames, in turn all kinds of failure, three pipettes, dye and
water, a fresh tip for each well and one tip for all. The failure strikes one of the last wells,
when Layer 2 has calibrated. Counted are the wells that the simulated robot entered between the
failed delivery and the hold; failures that no verdict told, and runs that were stopped before the
failed well, are counted apart. All results are simulated.
"""

from __future__ import annotations

import argparse
import json
import logging
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from itertools import product
from pathlib import Path

from .live_runs import FAULTS

FIRST_SEED = 31_000
WELLS = 9
STRUCK = (7, 8)
PIPETTES = {
    "p20_single_gen2": ("opentrons_96_tiprack_20ul", 15),
    "p300_single_gen2": ("opentrons_96_tiprack_300ul", 120),
    "p1000_single_gen2": ("opentrons_96_tiprack_1000ul", 400),
}
LIQUIDS = {"red dye": "#d02020", "water": "#cceeff"}
TEXT = """
metadata = {{"apiLevel": "2.15"}}

def run(protocol):
    tips = protocol.load_labware("{rack}", "1")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", "2")
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", "3")
    pipette = protocol.load_instrument("{pipette}", "left", [tips])
    liquid = protocol.define_liquid("{liquid}", "", "{colour}")
    reservoir["A1"].load_liquid(liquid, 14000)
    pipette.transfer(
        {volume}, reservoir["A1"], plate.wells()[:{wells}], new_tip="{new_tip}"
    )
"""


@dataclass(frozen=True)
class Trial:
    """What came of one planted failure.

    Attributes:
        fault: Planted.
        pipette, liquid: With what.
        new_tip: ``"always"`` or ``"once"``.
        came: ``"held"`` at the failed well, ``"missed"``, or ``"stopped early"``.
        touched: Wells entered between the failed delivery and the hold.
    """

    fault: str
    pipette: str
    liquid: str
    new_tip: str
    came: str
    touched: tuple[str, ...] = ()


def measure(count: int, first: int) -> Iterator[Trial]:
    """``count`` failures, one after another."""
    kinds = list(product(("always", "once"), LIQUIDS, PIPETTES, FAULTS))
    for number in range(count):
        # Five shares no factor with the number of combinations, so all of them come.
        new_tip, liquid, pipette, kind = kinds[number * 5 % len(kinds)]
        struck = STRUCK[number % len(STRUCK)]
        yield _trial(f"{kind}@#{struck}", pipette, liquid, new_tip, first + number)


def _trial(fault: str, pipette: str, liquid: str, new_tip: str, seed: int) -> Trial:
    from aegis_ot.adapters.opentrons.rehearsal import Script
    from aegis_ot.dryrun import TRUSTING, DryRunSettings, dry_run
    from aegis_ot.sidecar import make_analyser

    rack, volume = PIPETTES[pipette]
    text = TEXT.format(
        rack=rack, pipette=pipette, liquid=liquid, colour=LIQUIDS[liquid], volume=volume,
        wells=WELLS, new_tip=new_tip,
    )  # fmt: skip
    settings = DryRunSettings((fault,), on_fail="stop", seed=seed, rules="off", cascade=TRUSTING)
    done = dry_run(Script(text, "planted.py"), settings, make_analyser(TRUSTING))
    struck = int(fault.rpartition("#")[2]) - 1
    flagged = [row.trajectory for row in done.wells if row.flagged]
    if done.outcome != "stopped" or not flagged:
        return Trial(fault, pipette, liquid, new_tip, "missed")
    if flagged[0] != struck:
        came = "stopped early" if flagged[0] < struck else "missed"
        return Trial(fault, pipette, liquid, new_tip, came)
    return Trial(fault, pipette, liquid, new_tip, "held", done.touched_after_failure)


def show(trials: Sequence[Trial]) -> str:
    """The counts as text."""
    came = Counter(trial.came for trial in trials)
    touched = [well for trial in trials for well in trial.touched]
    lines = [
        f"{len(trials)} failures planted in dry runs on simulated frames",
        f"held at the failed well {came['held']}, missed {came['missed']}, "
        f"stopped at an earlier well {came['stopped early']}",
        f"wells touched between the failure and the hold: {len(touched)}",
        f"{'failure':14} {'held':>5} {'of':>4}",
    ]
    for kind in FAULTS:
        rows = [trial for trial in trials if trial.fault.startswith(f"{kind}@")]
        rows = [trial for trial in rows if trial.came != "stopped early"]
        lines.append(f"{kind:14} {sum(t.came == 'held' for t in rows):5} {len(rows):4}")
    lines += [f"touched {', '.join(t.touched)}: {t}" for t in trials if t.touched]
    return "\n".join(lines) + "\n"


def main(arguments: list[str] | None = None) -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.planted_failures", description=__doc__
    )
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=FIRST_SEED)
    parser.add_argument("--json", type=Path)
    given = parser.parse_args(arguments)
    logging.disable(logging.WARNING)
    trials = []
    for trial in measure(given.count, given.seed):
        trials.append(trial)
        sys.stderr.write(f"{len(trials)} of {given.count}: {trial.fault} {trial.came}\n")
    sys.stdout.write(show(trials))
    if given.json is not None:
        text = json.dumps([asdict(trial) for trial in trials], indent=1)
        given.json.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
