"""Tools for an agent over the Model Context Protocol: JSON-RPC 2.0, a message a line.

Written against the protocol's specification, of which a server with tools needs four methods. The
SDK of the protocol cannot stand beside every release of opentrons: both fix versions of the same
libraries.
"""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import IO, Any

from .. import __version__
from ..errors import AegisError

VERSIONS = ("2025-06-18", "2025-03-26", "2024-11-05")
"""Of the protocol, the newest first."""

_PARSE_ERROR, _INVALID_REQUEST, _NO_METHOD, _BAD_ARGUMENTS = -32700, -32600, -32601, -32602
_AT_A_TIME = 2


@dataclass(frozen=True)
class Tool:
    """Something that an agent may call.

    Attributes:
        name: Its name.
        description: What it does, for the agent.
        arguments: JSON schema of each argument, by name.
        required: Arguments that must be given.
        call: Does it; gives what JSON can hold, or a text.
        reads_only: Whether it changes nothing.
    """

    name: str
    description: str
    arguments: Mapping[str, Mapping[str, Any]]
    required: Sequence[str]
    call: Callable[..., Any]
    reads_only: bool = True

    def described(self) -> dict[str, Any]:
        """As ``tools/list`` tells of it."""
        schema = {
            "type": "object",
            "properties": dict(self.arguments),
            "required": list(self.required),
            "additionalProperties": False,
        }
        return {
            "name": self.name,
            "description": self.description,
            "inputSchema": schema,
            "annotations": {"readOnlyHint": self.reads_only},
        }


class ToolServer:
    """Serves tools until the other side closes."""

    def __init__(self, tools: Sequence[Tool], instructions: str) -> None:
        self._tools = {tool.name: tool for tool in tools}
        self._instructions = instructions
        self._writing = threading.Lock()

    def serve(self, incoming: IO[bytes], outgoing: IO[bytes]) -> None:
        """Answer message after message; calls run beside each other."""
        self._outgoing = outgoing
        with ThreadPoolExecutor(_AT_A_TIME, "aegis-ot-tool") as threads:
            for line in incoming:
                if not line.strip():
                    continue
                try:
                    message = json.loads(line)
                except ValueError:
                    self._send(None, error=(_PARSE_ERROR, "This is no JSON."))
                    continue
                if not isinstance(message, dict) or not isinstance(message.get("method"), str):
                    if not isinstance(message, dict) or "id" not in message:
                        self._send(None, error=(_INVALID_REQUEST, "This is no request."))
                elif "id" in message:  # what has none is a notification, and asks for nothing
                    self._take(message, threads)

    def _take(self, message: Mapping[str, Any], threads: ThreadPoolExecutor) -> None:
        number, method, given = message["id"], message["method"], message.get("params") or {}
        if method == "tools/call":
            threads.submit(self._call, number, given)
        elif method == "initialize":
            asked = given.get("protocolVersion")
            self._send(
                number,
                {
                    "protocolVersion": asked if asked in VERSIONS else VERSIONS[0],
                    "capabilities": {"tools": {"listChanged": False}},
                    "serverInfo": {"name": "aegis-ot", "version": __version__},
                    "instructions": self._instructions,
                },
            )
        elif method == "tools/list":
            self._send(number, {"tools": [tool.described() for tool in self._tools.values()]})
        elif method == "ping":
            self._send(number, {})
        else:
            self._send(number, error=(_NO_METHOD, f"There is no method {method}."))

    def _call(self, number: Any, given: Mapping[str, Any]) -> None:
        tool = self._tools.get(str(given.get("name")))
        arguments = given.get("arguments") or {}
        if tool is None:
            named = f"There is no tool {given.get('name')}."
            self._send(number, error=(_BAD_ARGUMENTS, named))
            return
        wrong = {*arguments} - {*tool.arguments} or {*tool.required} - {*arguments}
        if wrong:
            told = f"{tool.name}: unknown or missing arguments: {', '.join(sorted(wrong))}."
            self._send(number, error=(_BAD_ARGUMENTS, told))
            return
        is_error = False
        try:
            told = tool.call(**arguments)
        except AegisError as error:
            told, is_error = str(error), True
        except Exception as error:  # an agent is told, and goes on
            told, is_error = f"aegis-ot itself failed: {type(error).__name__}: {error}", True
        text = told if isinstance(told, str) else json.dumps(told, ensure_ascii=False, indent=1)
        self._send(number, {"content": [{"type": "text", "text": text}], "isError": is_error})

    def _send(self, number: Any, result: Any = None, error: tuple[int, str] | None = None) -> None:
        answer: dict[str, Any] = {"jsonrpc": "2.0", "id": number}
        if error is None:
            answer["result"] = result
        else:
            answer["error"] = {"code": error[0], "message": error[1]}
        data = json.dumps(answer).encode() + b"\n"
        with self._writing:
            self._outgoing.write(data)
            self._outgoing.flush()


def private_streams() -> tuple[IO[bytes], IO[bytes]]:
    """The standard streams, for messages alone: what else prints, prints to stderr."""
    incoming, outgoing = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nowhere, 0)
    os.close(nowhere)
    os.dup2(2, 1)
    return incoming, outgoing
