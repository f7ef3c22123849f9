"""The small protocol that every language or vision model stands behind.

A :class:`Request` goes in, a :class:`Reply` comes out. A reply is either an object that fits the
request's schema, or a named :class:`State` that says why there is none. Nothing that a model, a
network or a service does makes :meth:`Backend.ask` raise: a caller can not forget to look.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, Protocol

MAX_OUTPUT = 1200
"""Longest answer that is asked for, tokens; it bounds the cost of a call."""


class State(str, Enum):
    """How asking ended. Everything but ``ANSWERED`` leaves the question undecided."""

    ANSWERED = "answered"
    NO_MODEL = "no_model"
    """None is configured."""
    NO_KEY = "no_key"
    """The environment holds no key for this service."""
    UNAUTHORIZED = "unauthorized"
    """The service refused the key."""
    RATE_LIMITED = "rate_limited"
    """Still told to wait after the last retry."""
    UNAVAILABLE = "unavailable"
    """Overloaded, failing, or not reachable, still so after the last retry."""
    TIMEOUT = "timeout"
    """No answer in the time allowed."""
    BAD_REQUEST = "bad_request"
    """The service cannot serve this request: model unknown, too long, format not supported."""
    REFUSED = "refused"
    """The model or the service's filter declined to answer."""
    TRUNCATED = "truncated"
    """The answer ran into the limit of its length."""
    INVALID = "invalid"
    """The answer is no JSON, or does not fit the schema."""
    NOT_RECORDED = "not_recorded"
    """The replay folder holds no answer to this request."""


@dataclass(frozen=True)
class PromptPicture:
    """An image in a message.

    Attributes:
        data: The encoded file.
        media_type: ``"image/jpeg"`` or ``"image/png"``.
    """

    data: bytes = field(repr=False)
    media_type: str = "image/jpeg"

    @property
    def sha256(self) -> str:
        """Its content hash."""
        return hashlib.sha256(self.data).hexdigest()


@dataclass(frozen=True)
class Passage:
    """A part of the instructions. Cached ones are the same in many requests, and stand first."""

    text: str
    cached: bool = False


@dataclass(frozen=True)
class Message:
    """What is said to the model.

    Attributes:
        parts: Texts and pictures, in order.
        role: ``"user"`` or ``"assistant"``.
    """

    parts: tuple[str | PromptPicture, ...]
    role: str = "user"


@dataclass(frozen=True)
class Request:
    """One question.

    Attributes:
        purpose: What it is for, a word: ``"layer1"``, ``"gate"``. Names the answer format too.
        system: Instructions.
        messages: The question.
        schema: JSON schema of the answer (the subset of :mod:`aegis_ot.llm.schema`).
        max_output: Longest answer, tokens.
    """

    purpose: str
    system: tuple[Passage, ...]
    messages: tuple[Message, ...]
    schema: Mapping[str, Any]
    max_output: int = MAX_OUTPUT

    def to_json(self) -> dict[str, Any]:
        """Plain values; pictures by their hash."""
        return {
            "purpose": self.purpose,
            "system": [{"text": p.text, "cached": p.cached} for p in self.system],
            "messages": [
                {"role": m.role, "parts": [_part(part) for part in m.parts]} for m in self.messages
            ],
            "schema": self.schema,
            "max_output": self.max_output,
        }

    @property
    def hash(self) -> str:
        """SHA-256 of the request, the model left out: what replay and batches go by."""
        text = json.dumps(self.to_json(), sort_keys=True, ensure_ascii=False)
        return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()

    @property
    def pictures(self) -> tuple[PromptPicture, ...]:
        """All pictures, in order."""
        return tuple(p for m in self.messages for p in m.parts if isinstance(p, PromptPicture))


def _part(part: str | PromptPicture) -> dict[str, Any]:
    if isinstance(part, PromptPicture):
        return {"image": {"sha256": part.sha256, "media_type": part.media_type}}
    return {"text": part}


@dataclass(frozen=True)
class TokenUsage:
    """Tokens that a call took, as the service counted them.

    Attributes:
        input: Read at the full price.
        cached: Read from the service's prompt cache.
        cache_written: Written into it.
        output: Written by the model, its hidden reasoning included.
    """

    input: int = 0
    cached: int = 0
    cache_written: int = 0
    output: int = 0

    @property
    def total_input(self) -> int:
        """Everything that was read."""
        return self.input + self.cached + self.cache_written

    def __add__(self, other: TokenUsage) -> TokenUsage:
        return TokenUsage(
            self.input + other.input,
            self.cached + other.cached,
            self.cache_written + other.cache_written,
            self.output + other.output,
        )


@dataclass(frozen=True)
class Reply:
    """What came of asking.

    Attributes:
        state: How it ended.
        model: Which model answered, as the service names it.
        value: The answer, fitting the schema; ``None`` unless answered.
        detail: One sentence for people; never holds a key.
        usage: Tokens of all attempts that were counted.
        seconds: From the question to the answer, retries included.
        attempts: How often the service was asked.
        raw: What the model wrote, if anything; kept for records.
    """

    state: State
    model: str
    value: Mapping[str, Any] | None = None
    detail: str = ""
    usage: TokenUsage = TokenUsage()
    seconds: float = 0.0
    attempts: int = 1
    raw: str = field(default="", repr=False)

    @property
    def answered(self) -> bool:
        """Whether there is an answer."""
        return self.state is State.ANSWERED


class Backend(Protocol):
    """Anything that answers requests."""

    name: str
    """As the user named it: ``"anthropic:MODEL"``."""

    def ask(self, request: Request) -> Reply:
        """Answer one request. Does not raise; what goes wrong is the reply's state."""
