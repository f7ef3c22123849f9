"""Requests out, answers in, as lines of JSON: docs/reference/llm-batch.md.

For batch services, other machines, or a person with a text editor: whoever can read a request
can answer it.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aegis_ot.errors import ConfigurationError
from aegis_ot.llm.backend import Request, State
from aegis_ot.llm.backends.exporting import lines_of, read_requests, request_line
from aegis_ot.llm.backends.recording import add_answer, keep_picture
from aegis_ot.llm.schema import problem_of, read_answer
from aegis_ot.preflight.opinion import quote_problem
from aegis_ot.vocabulary import Citation


@dataclass(frozen=True)
class Imported:
    """What came of an import.

    Attributes:
        kept: Answers that were kept.
        problems: One sentence per answer that cannot be used, with its line.
    """

    kept: int
    problems: tuple[str, ...] = ()


def export_requests(requests: Iterable[tuple[str, Request]], out: Path) -> int:
    """Write one line per request; pictures go into ``images/`` beside the file.

    Args:
        requests: What each is about (a file name), and the request. Equal ones are written once.
        out: The file.

    Returns:
        How many lines.

    Raises:
        ConfigurationError: The file cannot be written.
    """
    lines: dict[str, str] = {}
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        for about, request in requests:
            for picture in request.pictures:
                keep_picture(out.parent, picture)
            lines.setdefault(request.hash, request_line(about, request))
        out.write_text("".join(lines.values()), encoding="utf-8")
    except OSError as error:
        raise ConfigurationError(f"Cannot write {out}: {error.strerror}.") from error
    return len(lines)


def import_answers(answers: Path, folder: Path, requests: Path | None = None) -> Imported:
    """Turn a file of answers into a replay folder; answers there already are kept.

    Args:
        answers: Lines ``{"id": ..., "answer": {...}, "model": ...}``; with ``requests`` also
            ``"about"``, the protocol's file, in place of ``id``.
        folder: The replay folder; made if missing.
        requests: The exported requests; with them each answer is checked against its form now
            rather than when it is used.

    Raises:
        ConfigurationError: A file cannot be read, or the folder not written.
    """
    asked = {} if requests is None else read_requests(requests)
    files = {} if requests is None else _ids_by_file(requests)
    kept = 0
    problems: list[str] = []
    for number, line in enumerate(lines_of(answers), 1):
        if not line.strip():
            continue
        where = f"{answers.name}, line {number}"
        try:
            given = json.loads(line)
        except (ValueError, RecursionError) as error:
            problems.append(f"{where}: is not JSON ({error}).")
            continue
        problem = _named_by_file(given, files) or _problem(given, asked)
        if problem:
            problems.append(f"{where}: {problem}")
            continue
        add_answer(folder, given["id"], _answer(given), asked.get(given["id"]))
        kept += 1
    return Imported(kept, tuple(problems))


_FORM = {
    "type": "object",
    "properties": {"id": {"type": "string"}, "model": {"type": "string"}},
    "required": ["id", "answer"],
}


def _ids_by_file(requests: Path) -> dict[str, list[str]]:
    """The ids of a file's requests, by the name of the file that each is about.

    Args:
        requests: A file that :func:`.read_requests` can read.
    """
    found: dict[str, list[str]] = {}
    for line in lines_of(requests):
        if line.strip():
            request = json.loads(line)
            found.setdefault(Path(str(request.get("about"))).name, []).append(request["id"])
    return found


def _named_by_file(given: Any, files: Mapping[str, Sequence[str]]) -> str:
    """Fill in the id of an answer that names the protocol; what is wrong with that, if anything."""
    if not isinstance(given, dict) or "id" in given or "about" not in given:
        return ""
    if not files:
        return "it names a protocol's file; --requests is needed to find its request."
    ids = files.get(Path(str(given["about"])).name, ())
    if len(ids) != 1:
        return f"{len(ids)} of the exported requests are about {given['about']!r}, expected one."
    given["id"] = ids[0]
    return ""


def _problem(given: Any, asked: Mapping[str, Mapping[str, Any]]) -> str:
    problem = problem_of(given, _FORM, "line")
    if problem:
        return f"{problem}."
    key = given["id"]
    if len(key) != 64 or any(c not in "0123456789abcdef" for c in key):
        return f"id {key[:20]!r} is not the id of a request (64 hexadecimal digits)."
    if not isinstance(given["answer"], (dict, str)):
        return "answer: expected an object, or the model's text."
    if asked:
        if key not in asked:
            return f"no request of the exported ones has the id {key[:12]}..."
        answer, problem = read_answer(given["answer"], asked[key]["schema"])
        problem = problem or _misquoted(answer or {}, asked[key])
        return f"{problem}." if problem else ""
    return ""


_SOURCE_LINE = re.compile(r"^(\d+)\|(.*)$", re.M)


def _misquoted(answer: Mapping[str, Any], request: Mapping[str, Any]) -> str:
    """The first quote for a role that does not stand in the source where the answer says so."""
    parts = (part for message in request["messages"] for part in message["parts"])
    text = "\n".join(str(part.get("text", "")) for part in parts)
    lines = [line for _, line in _SOURCE_LINE.findall(text)]
    for proposal in answer.get("roles", ()):
        for said in proposal["citations"]:
            if problem := quote_problem(Citation(said["line"], said["quote"]), lines):
                return f"role {proposal['role']!r}: {problem}"
    return ""


def _answer(given: Mapping[str, Any]) -> dict[str, Any]:
    usage = given.get("usage")
    return {
        "model": str(given.get("model") or "imported"),
        "state": State.ANSWERED.value,
        "answer": given["answer"],
        "usage": usage if isinstance(usage, dict) else {},
    }
