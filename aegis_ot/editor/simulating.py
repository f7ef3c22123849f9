"""A dry run for an agent, in a process of its own: a request on stdin, the result on stdout."""

from __future__ import annotations

import dataclasses
import json
import os
import sys
from enum import Enum
from pathlib import Path
from typing import Any

from ..errors import AegisError


def main() -> int:
    """Run; 0 if there is a result, 2 with one sentence on stderr if not."""
    answer = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # whatever the protocol prints
    asked = json.loads(sys.stdin.read())
    try:
        json.dump(_simulated(**asked), answer, ensure_ascii=False)
    except AegisError as error:
        sys.stderr.write(" ".join(str(error).split()) + "\n")
        return 2
    except ModuleNotFoundError as error:
        sys.stderr.write(f"Simulating needs {error.name}: pip install 'aegis-ot[sidecar]'.\n")
        return 2
    answer.close()
    return 0


def _simulated(path: str, faults: list[str], on_fail: str) -> dict[str, Any]:
    from ..dryrun import DryRunSettings, dry_run, read_script
    from ..sidecar import make_analyser

    settings = DryRunSettings(faults=tuple(faults), on_fail=on_fail)
    result = dry_run(read_script(Path(path)), settings, make_analyser(settings.cascade))
    names = ("well", "address", "volume_ul", "outcome", "failure", "reason", "line")
    rows = [dataclasses.asdict(row) for row in result.wells]
    return {
        "frames": "simulated",
        "outcome": result.outcome,
        "detail": result.detail,
        "wells": [{name: _plain(row[name]) for name in names} for row in rows],
        "flagged": [row.address for row in result.flagged],
        "touched_after_failure": list(result.touched_after_failure),
        "notes": list(result.notes),
    }


def _plain(value: Any) -> Any:
    return value.value if isinstance(value, Enum) else value


if __name__ == "__main__":
    sys.exit(main())
