"""Keeps requests and answers in a folder, and answers from one: docs/reference/llm-batch.md.

A folder holds ``<hash>.json`` per request and ``images/<sha256>.jpg``. The hash is that of the
request without the model, so one folder can hold several models' answers to one question. No
header, no address, no key is ever written.
"""

from __future__ import annotations

import json
import logging
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import ConfigurationError
from ...vocabulary import one_line
from ..backend import Backend, PromptPicture, Reply, Request, State, TokenUsage
from ..schema import read_answer

FORMAT = 1
_log = logging.getLogger(__name__)
_SUFFIX = {"image/jpeg": ".jpg", "image/png": ".png"}
_KEPT = {State.ANSWERED, State.REFUSED, State.TRUNCATED, State.INVALID}
"""What the model itself said; outages are not worth remembering."""


class RecordingBackend:
    """Asks another backend, and keeps what was asked and answered.

    Raises:
        ConfigurationError: The folder cannot be written.
    """

    def __init__(self, backend: Backend, folder: str | Path) -> None:
        self._backend = backend
        self.name = backend.name
        self.folder = Path(folder)
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ConfigurationError(
                f"The folder {self.folder} for recordings cannot be made: {error.strerror}."
            ) from error

    def ask(self, request: Request) -> Reply:
        """Ask, then keep."""
        reply = self._backend.ask(request)
        if reply.state in _KEPT:
            try:
                keep(self.folder, request, reply)
            except ConfigurationError as error:
                # The answer is there, and may have been paid for.
                _log.warning("An answer could not be recorded: %s", error)
        return reply


def keep(folder: Path, request: Request, reply: Reply) -> None:
    """Write one request with its answer; an earlier answer of the same model is replaced.

    Raises:
        ConfigurationError: The folder cannot be written.
    """
    answer = {
        "model": reply.model,
        "state": reply.state.value,
        # An object for people who look into the folder; what fits no form, as it was written.
        "answer": reply.raw if reply.value is None else dict(reply.value),
        "usage": {
            "input": reply.usage.input,
            "cached": reply.usage.cached,
            "cache_written": reply.usage.cache_written,
            "output": reply.usage.output,
        },
        "seconds": round(reply.seconds, 3),
    }
    for picture in request.pictures:
        keep_picture(folder, picture)
    add_answer(folder, request.hash, answer, request.to_json())


def add_answer(
    folder: Path, key: str, answer: Mapping[str, Any], request: Mapping[str, Any] | None
) -> None:
    """Put an answer into ``<hash>.json``; an earlier one of the same model is replaced.

    Args:
        folder: Of recordings.
        key: The request's hash.
        answer: ``model``, ``state``, ``answer``, ``usage``, perhaps ``seconds``.
        request: The request, where it is known.

    Raises:
        ConfigurationError: The folder cannot be written, or the answer not as JSON.
    """
    entry = _so_far(folder, key)
    answers = [a for a in _answers(entry) if a.get("model") != answer["model"]]
    kept = {
        "format": FORMAT,
        "hash": key,
        "request": request or entry.get("request"),
        "answers": [*answers, answer],
    }
    try:
        text = json.dumps(kept, ensure_ascii=False, indent=1)
    except RecursionError:
        raise ConfigurationError(f"The answer to {key[:12]} is nested too deeply.") from None
    # Half a surrogate pair, which no UTF-8 holds, stays the escape that JSON writes it as.
    _write(folder / f"{key}.json", text.encode("utf-8", "backslashreplace"))


def _so_far(folder: Path, key: str) -> dict[str, Any]:
    """What is kept so far. A damaged recording steps aside: a new answer may be paid for."""
    try:
        return read_entry(folder, key) or {}
    except ConfigurationError as error:
        path = folder / f"{key}.json"
        aside = path.with_suffix(".damaged")
        _log.warning("%s It is now %s.", error, aside.name)
        try:
            os.replace(path, aside)
        except OSError as problem:
            raise ConfigurationError(f"Cannot move {path}: {problem.strerror}.") from problem
        return {}


def keep_picture(folder: Path, picture: PromptPicture) -> str:
    """Write a picture once; returns its path relative to ``folder``."""
    name = f"images/{picture.sha256}{_SUFFIX.get(picture.media_type, '.bin')}"
    path = folder / name
    if not path.exists():
        _write(path, picture.data)
    return name


def _write(path: Path, data: bytes) -> None:
    """Whole or not at all."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=".writing-")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            os.replace(name, path)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise ConfigurationError(f"Cannot write {path}: {error.strerror}.") from error


class ReplayBackend:
    """Answers from a folder of recordings or imported answers; asks nobody.

    Args:
        folder: The folder.
        model: Whose answer to take; needed only where a question has answers of several models.

    Raises:
        ConfigurationError: There is no such folder.
    """

    def __init__(self, folder: str | Path, model: str | None = None) -> None:
        self.folder = Path(folder)
        self._model = model
        self.name = f"replay:{self.folder}" + (f"#model={model}" if model else "")
        if not self.folder.is_dir():
            raise ConfigurationError(
                f"There is no folder {self.folder} to replay from. Record one with --record, or "
                "make one with `aegis-ot llm import`."
            )

    def ask(self, request: Request) -> Reply:
        """The recorded answer, checked like a fresh one."""
        try:
            entry = read_entry(self.folder, request.hash)
        except ConfigurationError as error:
            return self._nothing(str(error))
        answers = _answers(entry or {})
        if self._model is not None:
            answers = [a for a in answers if a.get("model") == self._model]
        if not answers:
            whose = f" of {self._model}" if self._model else ""
            return self._nothing(
                f"{self.folder} holds no answer{whose} to this request ({request.hash[:12]}). "
                "The protocol, the rules or the prompt changed since, or it was never asked."
            )
        if len(answers) > 1:
            models = ", ".join(sorted(str(a.get("model")) for a in answers))
            return self._nothing(
                f"{self.folder} holds answers of several models ({models}). "
                "Choose one: replay:DIR#model=NAME."
            )
        return _reply(answers[0], request)

    def _nothing(self, detail: str) -> Reply:
        return Reply(State.NOT_RECORDED, self._model or "replay", detail=detail, attempts=0)


def _reply(answer: Mapping[str, Any], request: Request) -> Reply:
    model = one_line(answer.get("model"), 100) or "unknown"
    given = answer.get("answer")
    counts = answer.get("usage")
    usage = _usage(counts if isinstance(counts, Mapping) else {})
    seconds = answer.get("seconds")
    took = float(seconds) if isinstance(seconds, (int, float)) and 0 <= seconds < 1e6 else 0.0
    said = answer.get("state", State.ANSWERED.value)
    value, problem = read_answer(given, request.schema)
    raw = given if isinstance(given, str) else "" if value is None else json.dumps(value)
    if said in (State.REFUSED.value, State.TRUNCATED.value):
        detail = f"{model}: the recorded answer was {said}."
        return Reply(State(said), model, None, detail, usage, took, 0, raw)
    if value is None:
        detail = f"{model}: the recorded answer cannot be used: {problem}."
        return Reply(State.INVALID, model, None, detail, usage, took, 0, raw)
    return Reply(State.ANSWERED, model, value, "", usage, took, 0, raw)


def _usage(counts: Mapping[str, Any]) -> TokenUsage:
    def count(name: str) -> int:
        value = counts.get(name)
        if isinstance(value, int) and not isinstance(value, bool) and value >= 0:
            return value
        return 0

    return TokenUsage(count("input"), count("cached"), count("cache_written"), count("output"))


def read_entry(folder: Path, key: str) -> dict[str, Any] | None:
    """``<hash>.json``, or ``None`` where there is none.

    Raises:
        ConfigurationError: It is damaged, or of another format.
    """
    path = folder / f"{key}.json"
    try:
        entry = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except (OSError, ValueError, RecursionError) as error:
        raise ConfigurationError(f"The recording {path} cannot be read: {error}.") from error
    if not isinstance(entry, dict) or entry.get("format") != FORMAT:
        raise ConfigurationError(f"The recording {path} is not of format {FORMAT}.")
    return entry


def _answers(entry: Mapping[str, Any]) -> list[dict[str, Any]]:
    answers = entry.get("answers")
    return [a for a in answers if isinstance(a, dict)] if isinstance(answers, list) else []
