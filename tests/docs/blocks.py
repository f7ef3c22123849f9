"""Reads the fenced blocks of the documentation.

A ``sh`` block holds commands that a reader types. With a ``title`` it cannot be run by a test, and
the title, which the reader sees too, says why. A ``text`` block right after a block that is run is
what it prints. A ``python`` block with a title is a file of that name.
"""

from __future__ import annotations

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = [
    path
    for path in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    if path.parent.name != "rules"
]
TUTORIAL = [ROOT / "docs" / "tutorial" / f"{n}.md" for n in ("protocol", "camera", "first-run")]

_FENCE = re.compile(
    r"^(?P<in> *)```(?P<lang>\w*)(?: title=\"(?P<title>[^\"]*)\")?(?P<rest>[^\n]*)\n"
    r"(?P<body>.*?)^(?P=in)```$",
    re.MULTILINE | re.DOTALL,
)


@dataclass(frozen=True)
class Block:
    """One fenced block.

    Attributes:
        page: File.
        line: Of its fence.
        language: First word of the info string, ``""`` if none.
        title: ``""`` if none.
        body: Text, without the fence's indent.
        shows: The ``text`` block right after it, ``""`` if none.
    """

    page: Path
    line: int
    language: str
    title: str
    body: str
    shows: str = ""

    @property
    def place(self) -> str:
        return f"{self.page.relative_to(ROOT)}:{self.line}"

    def commands(self) -> list[str]:
        """Command lines, those continued with a backslash joined, comments left out."""
        joined = self.body.replace("\\\n", " ")
        lines = (re.sub(r"(^|\s)#.*$", "", line).strip() for line in joined.split("\n"))
        return [line for line in lines if line]


def blocks_of(page: Path) -> list[Block]:
    """The blocks of a page, in their order."""
    text = page.read_text(encoding="utf-8")
    found: list[Block] = []
    end = -1
    for match in _FENCE.finditer(text):
        assert not match["rest"].strip(), f"{page}: what is {match['rest']!r} of a fence?"
        body = re.sub(rf"^{match['in']}", "", match["body"], flags=re.MULTILINE)
        line = text.count("\n", 0, match.start()) + 1
        block = Block(page, line, match["lang"], match["title"] or "", body)
        if block.language == "text" and found and not text[end : match.start()].strip():
            last = found[-1]
            found[-1] = Block(
                last.page, last.line, last.language, last.title, last.body, block.body
            )
        found.append(block)
        end = match.end()
    return found


def words_of(command: str) -> tuple[dict[str, str], list[str]]:
    """Variables set before a command, and its words."""
    words = shlex.split(command)
    variables = {}
    while words and re.match(r"[A-Z_]+=", words[0]):
        name, _, value = words.pop(0).partition("=")
        variables[name] = value
    return variables, words
