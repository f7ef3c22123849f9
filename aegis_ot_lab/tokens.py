"""How many tokens a request takes, roughly, without asking anyone.

Tokenisers differ by model and none ships with the SDKs, so a request is sized by an estimate
that runs high: a word is one token per six letters begun, a number one per three digits begun,
every other character that is no space is one of its own, and so is every line break. On English
prose this gives about 20 % more than the usual "four characters a token", on code and tables,
where four characters a token is too few, about 50 % more.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass

from aegis_ot.llm.backend import PromptPicture, Request

_PIECES = re.compile(r"[^\W\d_]+|\d+|\n+|[^\w\s]|_")

PICTURE_TOKENS = 400
"""A cropped frame of the gate, about 550 px by 550 px (Anthropic: width × height / 750)."""


def estimate_tokens(text: str) -> int:
    """Tokens of a text, see the module."""
    count = 0
    for piece in _PIECES.findall(text):
        if piece[0].isalpha():
            count += -(-len(piece) // 6)
        elif piece[0].isdigit():
            count += -(-len(piece) // 3)
        else:
            count += 1
    return count


@dataclass(frozen=True)
class RequestSize:
    """Estimated tokens of a request: all of it, and the part that prompt caches keep."""

    total: int
    cached: int

    @property
    def cached_share(self) -> float:
        """From 0 to 1."""
        return self.cached / self.total if self.total else 0.0


def request_size(request: Request) -> RequestSize:
    """Estimate the input of a request. The answer's form goes before everything, and is cached."""
    form = estimate_tokens(json.dumps(request.schema))
    cached = sum(estimate_tokens(p.text) for p in request.system if p.cached)
    rest = sum(estimate_tokens(p.text) for p in request.system if not p.cached)
    for message in request.messages:
        for part in message.parts:
            picture = isinstance(part, PromptPicture)
            rest += PICTURE_TOKENS if picture else estimate_tokens(str(part))
    if cached:
        cached += form
    else:
        rest += form
    return RequestSize(cached + rest, cached)
