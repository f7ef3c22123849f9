"""How long the sentences of the documentation are: ``python -m scripts.sentences [PAGE...]``.

Words of prose alone count: no code, no tables, no headings. An item of a list ends a sentence.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

MOST_ON_AVERAGE = 16
MOST = 35

_FENCE = re.compile(r"^ *```.*?^ *```$", re.M | re.S)
_NO_PROSE = re.compile(r"^\s*(?:\||#|<!--|!\[|:?-{3,})")
_ITEM = re.compile(r"^\s*(?:[-*]|\d+\.)\s+")
_END = re.compile(r"(?<=[.!?:])[*_)\"']*\s+(?=[\"'*_(`]*[A-Z0-9`])")
_LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")


def pages() -> list[Path]:
    """README, tutorial and how-tos."""
    docs = ROOT / "docs"
    return [ROOT / "README.md", *sorted((docs / "tutorial").glob("*.md")),
            *sorted((docs / "how-to").glob("*.md"))]  # fmt: skip


def sentences(text: str) -> list[str]:
    """The sentences of a page, in their order. A colon before a capital ends one."""
    return [
        sentence
        for paragraph in _paragraphs(_FENCE.sub("\n", text))
        for sentence in _END.split(_LINK.sub(r"\1", paragraph))
        if words(sentence)
    ]


def words(sentence: str) -> int:
    """How many words it has; what stands as code is one."""
    plain = re.sub(r"`[^`]*`", "code", sentence)
    return len(re.findall(r"[^\W_]+(?:['’.,/-][^\W_]+)*", plain))


def _paragraphs(text: str) -> Iterator[str]:
    part: list[str] = []
    for line in [*text.split("\n"), ""]:
        ends = not line.strip() or _NO_PROSE.match(line)
        if (ends or _ITEM.match(line)) and part:
            yield " ".join(part)
            part = []
        if not ends:
            part.append(_ITEM.sub("", line).strip())


def measured(page: Path) -> tuple[float, int, list[str]]:
    """Mean length in words, the longest, and the sentences that are too long."""
    found = sentences(page.read_text(encoding="utf-8"))
    lengths = [words(sentence) for sentence in found]
    too_long = [one for one, length in zip(found, lengths, strict=True) if length > MOST]
    return sum(lengths) / max(len(lengths), 1), max(lengths, default=0), too_long


def main() -> int:
    named = [Path(name) for name in sys.argv[1:]]
    print(f"{'page':<44}{'mean':>6}{'longest':>9}{'too long':>10}")
    for page in named or pages():
        mean, longest, too_long = measured(page)
        shown = page.resolve().relative_to(ROOT).as_posix()
        print(f"{shown:<44}{mean:>6.1f}{longest:>9}{len(too_long):>10}")
        for sentence in too_long if named else ():
            print(f"  {words(sentence)}: {sentence}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
