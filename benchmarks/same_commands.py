"""``python -m benchmarks.same_commands FOLDER ... [--engines 8.2.0 9.0.0] [--each 30] [--seed N]``.

The guard changes nothing: protocols of a laboratory's own folders, guarded and unguarded, on each
``opentrons`` that is here (``aegis-ot engines list``). So many are drawn for each release as
simulate by themselves; their whole command lists, with all parameters, have to be the same. Both
layers are at work: a sidecar on loopback answers every keyframe. The files are only read.

Exit status 1: a list differs. 2: there is nothing to compare.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import subprocess
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from aegis_ot.workbench.engines import Engine, Need, here, installed, need_of

AT_ONCE = 16
"""Protocols for which one interpreter of a processor is started."""
ROOT = Path(__file__).resolve().parent.parent


@dataclass
class Compared:
    """What came of one release.

    Attributes:
        same: Protocols whose lists are the same.
        different: Those whose are not, with what differs first.
        unfit: Those that do not simulate by themselves; the guard made no difference.
        commands, keyframes: In all lists that are the same.
    """

    same: list[str] = field(default_factory=list)
    different: dict[str, str] = field(default_factory=dict)
    unfit: list[str] = field(default_factory=list)
    commands: int = 0
    keyframes: int = 0

    def add(self, path: Path, found: dict[str, Any]) -> str:
        """Count one protocol; what came of it, in a line."""
        if found["problems"]:
            self.different[str(path)] = found["problems"][0]
            return f"  DIFFERENT: {path}: {' '.join(found['problems'][0].split())[:300]}"
        if found["own_error"] or not (found["lines"] or found["engine_commands"]):
            self.unfit.append(str(path))
            why = found["own_error"] or "it does nothing"
            return f"  left out: {path}: {' '.join(why.split())[:120]}"
        self.same.append(str(path))
        self.commands += found["engine_commands"] or found["lines"]
        self.keyframes += found["keyframes"]
        return f"  the same: {path} ({found['keyframes']} keyframes)"


def protocols_in(folders: Sequence[Path]) -> Iterator[tuple[Path, Need]]:
    """Each protocol below the folders once, whatever its copies are called."""
    known = set()
    for path in sorted(path for folder in folders for path in folder.resolve().rglob("*.py")):
        text = path.read_text(encoding="utf-8", errors="replace")
        need = need_of(text) if "def run(" in text and "aegis_ot" not in text else None
        if need is not None and text not in known:
            known.add(text)
            yield path, need


def compared(
    engine: Engine, protocols: Sequence[tuple[Path, Need]], each: int, processor_s: int
) -> Compared:
    """Compare protocols, in the order given, until ``each`` were found to be the same."""
    found = Compared()
    fit = [path for path, need in protocols if engine.serves(need)]
    python = engine.python or sys.executable
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        while fit and len(found.same) < each:
            several = min(len(fit), AT_ONCE, each - len(found.same) + 2)
            paths, fit = fit[:several], fit[several:]
            parts = [paths[n :: os.cpu_count() or 1] for n in range(os.cpu_count() or 1)]
            for part, told in zip(
                parts,
                pool.map(lambda part: _compare(python, part, processor_s), parts),
                strict=True,
            ):
                for path, one in zip(part, told, strict=True):
                    print(found.add(path, one), flush=True)
    return found


def _compare(python: str, paths: Sequence[Path], processor_s: int) -> list[dict[str, Any]]:
    """Protocols in another interpreter, each in a process of its own there."""
    if not paths:
        return []
    command = [python, "-m", "tests.compat.transparency", f"--each={processor_s}", *map(str, paths)]
    environment = {k: v for k, v in os.environ.items() if not k.startswith("AEGIS_OT_")}
    done = subprocess.run(
        command, cwd=ROOT, env={**environment, "PYTHONPATH": str(ROOT)},
        capture_output=True, text=True, stdin=subprocess.DEVNULL, check=True,
    )  # fmt: skip
    unknown = {"own_error": None, "lines": 0, "keyframes": 0, "engine_commands": 0}
    return [{**unknown, **one} for one in json.loads(done.stdout)["protocols"]]


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare, and print what was found."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.same_commands", description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--engines", nargs="+", help="releases of opentrons; all here if left out")
    parser.add_argument("--each", type=int, default=30)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--longest", type=int, default=60, help="processor time of a protocol, s")
    asked = parser.parse_args(arguments)
    own = here()
    engines = {engine.version: engine for engine in [*installed(), *([own] if own else [])]}
    missing = set(asked.engines or ()) - set(engines)
    if missing:
        parser.error(f"not here: {', '.join(sorted(missing))}; aegis-ot engines install makes one")
    protocols = list(protocols_in(asked.folders))
    random.Random(asked.seed).shuffle(protocols)
    same = different = 0
    for version in asked.engines or engines:
        found = compared(engines[version], protocols, asked.each, asked.longest)
        same, different = same + len(found.same), different + len(found.different)
        print(
            f"opentrons {version}: {len(found.same)} protocols the same ({found.commands} commands "
            f"compared, {found.keyframes} keyframes), {len(found.different)} different, "
            f"{len(found.unfit)} do not simulate by themselves.",
            flush=True,
        )
    return 1 if different else 0 if same else 2


if __name__ == "__main__":
    sys.exit(main())
