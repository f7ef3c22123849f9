"""Reads the file of examples beside a rule file: ``pcr.json``, ``pcr.examples.py``.

A comment heads each snippet, which reaches to the next heading::

    # deck
    master_mix, ntc = tubes["A1"], plate["H12"]

    # PCR-1, PCR-6 passes: master mix for the NTC as well
    p20.transfer(18, master_mix, [plate["A1"], ntc])

    # PCR-1 fails: the NTC is left out
    p20.transfer(18, master_mix, plate["A1"])

A ``deck`` stands before each snippet that follows, up to the next ``deck``. ``fails`` means with an
error, ``warns`` with warnings only. Of a failing snippet the first rule is the one that it is for;
the others are broken with it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Literal

from ..errors import RuleError
from ..preflight.rules import Example, Examples, Family

_HEADING = re.compile(r"# (?:deck|(?P<rules>[\w-]+(?:, [\w-]+)*) (?P<does>\w+): (?P<title>\S.*))$")
_SEVERITY: Mapping[str, Literal["error", "warning"]] = {"fails": "error", "warns": "warning"}


def examples_of(family: Family) -> Mapping[str, Examples]:
    """The examples of each rule: those of the rule file, then those of the file beside it.

    Raises:
        RuleError: The file cannot be read, or a heading in it is wrong; with the line.
    """
    examples = {rule.id: rule.examples for rule in family.rules}
    path = Path(family.path or "nowhere").with_suffix(".examples.py")
    if not path.is_file():
        return examples
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise RuleError(f"{path.name}: cannot be read: {error}") from None
    headings = [(n, found) for n, line in enumerate(lines) if (found := _HEADING.match(line))]
    ends = [n for n, _ in headings[1:]] + [len(lines)]
    deck: tuple[str, ...] = ()
    for (start, heading), end in zip(headings, ends, strict=True):
        code = _code(lines[start + 1 : end])
        if heading["rules"] is None:
            deck = code
            continue
        rules = heading["rules"].split(", ")
        unknown = [rule for rule in rules if rule not in examples]
        if unknown:
            raise RuleError(f"{path.name}, line {start + 1}: there is no rule {unknown[0]} there")
        if heading["does"] == "passes":
            example = Example(heading["title"], (*deck, *code))
            for rule in rules:
                old = examples[rule]
                examples[rule] = Examples((*old.passing, example), old.failing)
        elif heading["does"] in _SEVERITY:
            example = Example(
                heading["title"], (*deck, *code), tuple(rules[1:]), _SEVERITY[heading["does"]]
            )
            old = examples[rules[0]]
            examples[rules[0]] = Examples(old.passing, (*old.failing, example))
        else:
            told = f"a snippet passes, fails or warns, and not {heading['does']!r}"
            raise RuleError(f"{path.name}, line {start + 1}: {told}")
    return examples


def _code(lines: list[str]) -> tuple[str, ...]:
    """A snippet's lines without the blank ones around them."""
    kept = [n for n, line in enumerate(lines) if line.strip()]
    return tuple(lines[kept[0] : kept[-1] + 1]) if kept else ()
