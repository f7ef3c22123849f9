"""Anthropic's Messages API through its SDK.

The answer's format is a tool that the model must call: it works with every version of the SDK
and every Claude model; ``structured=output`` uses the API's own output format instead. The
instructions that many requests share are marked for the prompt cache.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from typing import Any

from ...errors import ConfigurationError
from ..backend import Message, PromptPicture, Request, TokenUsage
from .service import RequestOptions, ServiceBackend, Written, count

KEY_VARIABLES = ("ANTHROPIC_API_KEY",)
STRUCTURED = ("tool", "output")


class AnthropicBackend(ServiceBackend):
    """Asks Claude.

    Args:
        model: As Anthropic names it.
        base_url: Another address of the same API (a gateway, a test); ``None``: Anthropic's.
        structured: ``"tool"`` or ``"output"``; ``None``: ``"tool"``.
        key_variables: Environment variables that may hold the key; ``None``: Anthropic's own.
        manner: How to ask.
    """

    package = "anthropic"

    def __init__(
        self,
        model: str,
        base_url: str | None = None,
        structured: str | None = None,
        key_variables: tuple[str, ...] | None = None,
        manner: RequestOptions | None = None,
    ) -> None:
        self._structured = structured or "tool"
        if self._structured not in STRUCTURED:
            raise ConfigurationError(
                f"structured={structured!r} is not known for Anthropic; use one of "
                f"{', '.join(STRUCTURED)}."
            )
        self._base_url = base_url
        name = f"anthropic:{model}" + (f"@{base_url}" if base_url else "")
        super().__init__(
            name,
            model,
            "Anthropic",
            key_variables or KEY_VARIABLES,
            True,
            manner or RequestOptions(),
        )

    def _connect(self, sdk: Any, key: str, common: Mapping[str, Any]) -> Any:
        return sdk.Anthropic(api_key=key, base_url=self._base_url, **common)

    def _send(self, client: Any, request: Request, left: float) -> Any:
        return client.messages.create(**self._arguments(request), timeout=left)

    def _arguments(self, request: Request) -> dict[str, Any]:
        arguments: dict[str, Any] = {
            "model": self.model,
            "max_tokens": self._room(request),
            "system": [_passage(p.text, p.cached) for p in request.system],
            "messages": [_message(m) for m in request.messages],
        }
        if self._manner.temperature is not None:
            arguments["temperature"] = self._manner.temperature
        if self._structured == "output":
            # Through extra_body, since older SDKs do not know the argument.
            arguments["extra_body"] = {
                "output_config": {"format": {"type": "json_schema", "schema": request.schema}}
            }
        else:
            arguments["tools"] = [
                {
                    "name": request.purpose,
                    "description": "Give the answer in this form.",
                    "input_schema": request.schema,
                }
            ]
            arguments["tool_choice"] = {"type": "tool", "name": request.purpose}
        return arguments

    def _take_apart(self, answer: Any) -> Written:
        stop = getattr(answer, "stop_reason", None)
        blocks = getattr(answer, "content", None) or []
        said = "".join(str(b.text) for b in blocks if getattr(b, "type", "") == "text")
        calls = [b.input for b in blocks if getattr(b, "type", "") == "tool_use"]
        usage = getattr(answer, "usage", None)
        return Written(
            model=str(getattr(answer, "model", None) or ""),
            text=json.dumps(calls[0], ensure_ascii=False) if calls else said,
            usage=TokenUsage(
                count(usage, "input_tokens"),
                count(usage, "cache_read_input_tokens"),
                count(usage, "cache_creation_input_tokens"),
                count(usage, "output_tokens"),
            ),
            refusal=said if stop == "refusal" else None,
            is_cut=stop in ("max_tokens", "model_context_window_exceeded"),
        )


def _passage(text: str, cached: bool) -> dict[str, Any]:
    block: dict[str, Any] = {"type": "text", "text": text}
    if cached:
        block["cache_control"] = {"type": "ephemeral"}
    return block


def _message(message: Message) -> dict[str, Any]:
    content = [
        {
            "type": "image",
            "source": {
                "type": "base64",
                "media_type": part.media_type,
                "data": base64.b64encode(part.data).decode("ascii"),
            },
        }
        if isinstance(part, PromptPicture)
        else {"type": "text", "text": part}
        for part in message.parts
    ]
    return {"role": message.role, "content": content}
