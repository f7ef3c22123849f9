"""The same protocol asks the same question in every process: replay, batches and the sidecar's
memory go by its hash."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

BENCHMARK = Path(__file__).parents[2] / "examples" / "benchmark"

HASHES = """
import sys
from pathlib import Path
from aegis_ot.preflight import load_rules
from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.llm.layer1_prompt import hybrid_request
from tests.llm.samples import check_with_dossier

rule_set = load_rules()
for path in map(Path, sys.argv[1:]):
    dossier = check_with_dossier(Script(path.read_text(), path.name), rule_set)[1]
    asked = hybrid_request(dossier, rule_set)
    print(path.name, dossier.digest, asked.hash)
"""


def test_no_set_decides_an_order() -> None:
    """Python's sets of texts are in another order in every process."""
    files = [str(path) for path in sorted(BENCHMARK.glob("b*.py"))]
    running = [
        subprocess.Popen(
            [sys.executable, "-c", HASHES, *files],
            env=os.environ | {"PYTHONHASHSEED": seed},
            stdout=subprocess.PIPE,
            text=True,
        )
        for seed in ("1", "2")
    ]
    first, second = (process.communicate()[0].splitlines() for process in running)
    assert len(first) == len(files) == 24
    assert first == second
