"""Writes and reads the table of ``docs/reference/keyframes.md``.

``python -m tests.runtime.table`` writes it anew from what the simulator shows; read the
difference before you commit it.
"""

from __future__ import annotations

import re
from pathlib import Path

DOCUMENT = Path(__file__).parents[2] / "docs" / "reference" / "keyframes.md"
_ROW = re.compile(r"^\| ([a-z0-9 ]+) \| `(.*)` \|$", re.MULTILINE)
_HEADER = "| call | what happens |\n|---|---|\n"


def rows() -> dict[str, str]:
    """Name of the call -> what the table says."""
    return dict(_ROW.findall(DOCUMENT.read_text(encoding="utf-8")))


def main() -> None:
    from .calls import CASES
    from .recorded import record

    text = DOCUMENT.read_text(encoding="utf-8").split(_HEADER)[0]
    lines = []
    for name, (function, api, robot, settings) in CASES.items():
        words = " ".join(record(function, api, robot, **settings).words)
        lines.append(f"| {name} | `{words}` |\n")
    DOCUMENT.write_text(text + _HEADER + "".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
