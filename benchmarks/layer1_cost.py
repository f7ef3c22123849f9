"""Layer 1 from file to verdict, against an unguarded simulation of the same file."""

from __future__ import annotations

import json
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from .children import in_child
from .figure import Figure
from .guard_overhead import measure, simulate
from .memory import peak_mb
from .protocols import COMMANDS, plate_protocol

REPETITIONS = 5
TARGET_RATIO = 1.5
TARGET_SHARE = 5.0
TARGET_MB = 50.0


def figures() -> Iterator[Figure]:
    """Time and memory of a check."""
    data = f"{COMMANDS} commands, apiLevel 2.20"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bench_protocol.py"
        path.write_text(plate_protocol(), encoding="utf-8")
        times = measure(
            {"simulate": lambda: simulate(path.read_text()), "check": lambda: check(path)},
            REPETITIONS,
        )
        shares = [_verdict_share(path) for _ in range(REPETITIONS)]
        base = in_child("layer1_cost", "simulate", str(path))
        checked = in_child("layer1_cost", "check", str(path))
    medians = {name: statistics.median(taken) for name, taken in times.items()}
    yield Figure(
        "Layer 1, file to verdict / unguarded opentrons.simulate", data, "simulator",
        medians["check"] / medians["simulate"], "x", TARGET_RATIO,
        note=f"ratio of the fastest ones {min(times['check']) / min(times['simulate']):.3f}",
    )  # fmt: skip
    yield Figure(
        "Layer 1, verdict after the rehearsal / rehearsal", data, "simulator",
        100 * statistics.median(shares), "%", TARGET_SHARE,
    )  # fmt: skip
    yield Figure(
        "Layer 1, peak memory above the simulation's", data, "simulator", checked - base, "MB",
        TARGET_MB, note=f"fresh processes: {checked:.0f} MB and {base:.0f} MB",
    )  # fmt: skip


def check(path: Path) -> None:
    """File to verdict, as ``aegis-ot check`` does it once Opentrons is loaded."""
    from aegis_ot.adapters.opentrons.rehearsal import Script
    from aegis_ot.preflight import check_script
    from aegis_ot.workbench.files import read_protocol

    check_script(Script(read_protocol(path), path.name))


def _verdict_share(path: Path) -> float:
    """Time of the verdict, rules loaded, over the time of the rehearsal."""
    from aegis_ot.adapters.opentrons.rehearsal import Script
    from aegis_ot.preflight import Interpretation, judge, load_rules, record

    script, rule_set = Script(path.read_text(), path.name), load_rules()
    begun = time.process_time()
    recording = record(script)
    rehearsed = time.process_time()
    judge(Interpretation(recording, rule_set))
    return (time.process_time() - rehearsed) / (rehearsed - begun)


def main(what: str, path: str) -> None:
    """In the child: do one of the two, and print the peak memory."""
    if what == "simulate":
        simulate(Path(path).read_text())
    else:
        import opentrons.simulate  # noqa: F401  (so that both have the same loaded)

        check(Path(path))
    print(json.dumps(peak_mb()))


if __name__ == "__main__":
    main(*sys.argv[1:])
