"""Files of requests, one JSON object a line: docs/reference/llm-batch.md."""

from __future__ import annotations

import json
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import ConfigurationError
from ..backend import Reply, Request, State
from .recording import FORMAT, keep_picture


def request_line(about: str, request: Request) -> str:
    """One request as a line of the file; ``about`` is for people."""
    line = {"format": FORMAT, "id": request.hash, "about": about, **request.to_json()}
    return json.dumps(line, ensure_ascii=False) + "\n"


class ExportBackend:
    """Answers nothing and writes down what it is asked, for answers to be got elsewhere.

    So whatever asks a model, the gate of Layer 2 included, can be served by a batch: run it
    once with ``export:FILE``, import the answers, and run it again with ``replay:FOLDER``.

    Args:
        out: File of requests; those that it holds already stay, and are not written again.

    Raises:
        ConfigurationError: The file is there and is no file of requests.
    """

    def __init__(self, out: str | Path) -> None:
        self._out = Path(out)
        self.name = f"export:{self._out}"
        self._known = set(read_requests(self._out)) if self._out.exists() else set()
        self._one_at_a_time = threading.Lock()

    def ask(self, request: Request) -> Reply:
        """Write it down; the state is ``NOT_RECORDED``."""
        detail = f"the request is in {self._out}; import its answer, and name replay:FOLDER."
        try:
            with self._one_at_a_time:
                if request.hash not in self._known:
                    self._write(request)
        except (OSError, ConfigurationError) as error:
            detail = f"{self._out} cannot be written ({error})."
        return Reply(State.NOT_RECORDED, self.name, detail=detail, attempts=0)

    def _write(self, request: Request) -> None:
        self._out.parent.mkdir(parents=True, exist_ok=True)
        for picture in request.pictures:
            keep_picture(self._out.parent, picture)
        with self._out.open("a", encoding="utf-8") as file:
            file.write(request_line("", request))
        self._known.add(request.hash)


def read_requests(requests: Path) -> dict[str, Mapping[str, Any]]:
    """The requests of a file, by their ids.

    Raises:
        ConfigurationError: It cannot be read, or a line is no request.
    """
    found: dict[str, Mapping[str, Any]] = {}
    for number, line in enumerate(lines_of(requests), 1):
        if not line.strip():
            continue
        try:
            request = json.loads(line)
            found[request["id"]] = {
                name: request[name]
                for name in ("purpose", "system", "messages", "schema", "max_output")
            }
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise ConfigurationError(
                f"{requests}, line {number} is no exported request ({error})."
            ) from error
    return found


def lines_of(path: Path) -> list[str]:
    """The lines of a file; JSON keeps line ends of other kinds inside its texts.

    Raises:
        ConfigurationError: It cannot be read.
    """
    try:
        # Some editors and shells begin a file with a mark of its encoding.
        return path.read_text(encoding="utf-8-sig").split("\n")
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"{path} cannot be read: {error}.") from error
