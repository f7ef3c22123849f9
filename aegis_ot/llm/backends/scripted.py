"""A backend that says what it was told to say: for tests, and for trying things out."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from ..backend import Reply, Request, State, TokenUsage
from ..schema import read_answer

Answer = Mapping[str, Any] | State | str | Reply
"""An object to answer with, a state to end in, text as a model would write it, or a reply."""


class ScriptedBackend:
    """Answers from a list, or by a function of the request. Keeps the requests.

    Answers go through the same checks as those of real models.

    Args:
        answers: One after the other; after the last one the state is ``NOT_RECORDED``.
        usage: Reported with every answer.
    """

    name = "scripted"

    def __init__(
        self,
        answers: Iterable[Answer] | Callable[[Request], Answer],
        usage: TokenUsage | None = None,
    ) -> None:
        self._answers = answers if callable(answers) else iter(list(answers))
        self._usage = usage or TokenUsage()
        self.requests: list[Request] = []

    def ask(self, request: Request) -> Reply:
        """The next answer."""
        self.requests.append(request)
        if callable(self._answers):
            answer: Answer = self._answers(request)
        else:
            answer = next(self._answers, State.NOT_RECORDED)
        if isinstance(answer, Reply):
            return answer
        if isinstance(answer, State):
            return Reply(answer, self.name, detail="The script says so.", usage=self._usage)
        raw = answer if isinstance(answer, str) else json.dumps(answer, ensure_ascii=False)
        value, problem = read_answer(raw, request.schema)
        if value is None:
            return Reply(
                State.INVALID,
                self.name,
                detail=f"The script gave an answer that {problem}.",
                usage=self._usage,
                raw=raw,
            )
        return Reply(State.ANSWERED, self.name, value, usage=self._usage, raw=raw)
