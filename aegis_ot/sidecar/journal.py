"""The sidecar's log: runs, verdicts, decisions, logins and trouble, one line each."""

from __future__ import annotations

import json
import logging
import sys
from datetime import datetime, timezone
from typing import Any

from ..vocabulary import one_line, printable, without_secrets

_LONGEST = 8000
EVENTS = logging.getLogger("aegis_ot.sidecar.events")


def event(name: str, **facts: Any) -> None:
    """Log that something happened. ``facts`` hold no secrets: they are written as they are."""
    EVENTS.info(name, extra={"facts": facts})


def set_up(form: str) -> None:
    """Log to standard error from now on.

    Args:
        form: ``"text"`` for people, ``"json"`` for one JSON object a line.
    """
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(_Json() if form == "json" else _Text())
    logger = logging.getLogger("aegis_ot")
    logger.handlers[:] = [handler]
    logger.setLevel(logging.INFO)
    logger.propagate = False


def _moment(record: logging.LogRecord) -> str:
    moment = datetime.fromtimestamp(record.created, timezone.utc)
    return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")


class _Json(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        line: dict[str, Any] = {"at": _moment(record), "level": record.levelname.lower()}
        facts = getattr(record, "facts", None)
        if facts is not None:
            line |= {"event": record.getMessage()} | facts
        else:
            line |= {"event": "log", "logger": record.name, "message": record.getMessage()}
        if record.exc_info:
            line["trace"] = self.formatException(record.exc_info)
        return without_secrets(json.dumps(line, ensure_ascii=False, default=str))


class _Text(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        facts = getattr(record, "facts", {})
        told = " ".join(f"{k}={v}" for k, v in facts.items() if v not in (None, ""))
        # What a robot or a person says must neither look like a line of ours nor steer a terminal.
        said = one_line(f"{record.getMessage()} {told}", _LONGEST)
        text = f"{_moment(record)} {record.levelname.lower():7} {said}"
        if record.exc_info:
            trace = self.formatException(record.exc_info)
            text += "".join(f"\n    {printable(line)}" for line in trace.splitlines())
        return without_secrets(text.rstrip())
