from __future__ import annotations

import re

from rich.cells import cell_len

from aegis_ot.reports.check_line import check_line
from aegis_ot.reports.check_text import check_text
from aegis_ot.reports.wrapping import wrapped

from .sample import RUN

_COLOUR = re.compile(r"\x1b\[[\d;]*m")


def test_a_report_fits_a_narrow_terminal_and_says_the_same() -> None:
    text = check_text(RUN, colour=True)
    folded = wrapped(text, 60)
    bare = _COLOUR.sub("", folded).split("\n")
    prose = [line for line in bare if "|" not in line and "@guard(" not in line]
    assert max(map(cell_len, prose)) <= 60
    assert folded.split() == text.split()
    assert wrapped(text, 10_000) == text


def test_a_line_for_each_finding() -> None:
    lines = check_line(RUN).splitlines()
    findings = [one for checked in RUN.protocols for one in checked.findings]
    assert sum(any(f" {one.rule} " in line for one in findings) for line in lines) >= len(findings)
    assert all(re.match(r".+?(:\d+)?: (error|warning|undecided) ", line) for line in lines[:-1])
