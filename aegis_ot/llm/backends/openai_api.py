"""OpenAI's chat completions, and every server that speaks them, through the ``openai`` SDK.

OpenAI itself, NVIDIA NIM, Ollama, vLLM and llama.cpp differ in how they are told the answer's
format and in the name of the length limit; :data:`PROFILES` holds what is known of each, and
the backend's name can override it.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from ...errors import ConfigurationError
from ..backend import Message, PromptPicture, Request, TokenUsage
from .keys import GENERIC
from .service import RequestOptions, ServiceBackend, Written, count, member

STRUCTURED = ("json_schema", "tool", "guided_json", "json_object")
LIMITS = ("max_tokens", "max_completion_tokens")
_OPENAI = "https://api.openai.com/v1"


@dataclass(frozen=True)
class Profile:
    """How one kind of server is spoken to.

    Attributes:
        structured: How it is told the format: ``json_schema`` (response format), ``tool`` (a
            function that must be called), ``guided_json`` (NIM's own field) or ``json_object``
            (any JSON; the schema stands in the instructions).
        limit: Name of the length limit.
        keys: Environment variables that may hold its key.
        needs_key: Whether asking without a key is pointless.
        strict: Whether it can be told to keep to the schema strictly.
    """

    structured: str = "json_schema"
    limit: str = "max_tokens"
    keys: tuple[str, ...] = (GENERIC,)
    needs_key: bool = False
    strict: bool = False


PROFILES = {
    "api.openai.com": Profile(
        limit="max_completion_tokens", keys=("OPENAI_API_KEY",), needs_key=True, strict=True
    ),
    "integrate.api.nvidia.com": Profile(
        "guided_json", keys=("NVIDIA_API_KEY", "NIM_API_KEY", GENERIC), needs_key=True
    ),
}
"""By host; any other host is taken as a server of the user's own."""


class OpenAIBackend(ServiceBackend):
    """Asks an OpenAI-compatible server.

    Args:
        model: As the server names it.
        base_url: Up to and with ``/v1``; ``None``: OpenAI itself.
        structured: See :class:`Profile`; ``None``: the profile's.
        limit: Name of the length limit; ``None``: the profile's.
        key_variables: Environment variables that may hold the key; ``None``: the profile's.
            OpenAI's own key goes to OpenAI only.
        manner: How to ask.
    """

    package = "openai"

    def __init__(
        self,
        model: str,
        base_url: str | None = None,
        structured: str | None = None,
        limit: str | None = None,
        key_variables: tuple[str, ...] | None = None,
        manner: RequestOptions | None = None,
    ) -> None:
        self._base_url = base_url or _OPENAI
        host = urlsplit(self._base_url).hostname or self._base_url
        profile = PROFILES.get(host, Profile())
        self._structured = structured or profile.structured
        if self._structured not in STRUCTURED:
            raise ConfigurationError(
                f"structured={structured!r} is not known for OpenAI-compatible servers; use one "
                f"of {', '.join(STRUCTURED)}."
            )
        self._limit = limit or profile.limit
        if self._limit not in LIMITS:
            raise ConfigurationError(
                f"limit={limit!r} is no length limit; use one of {', '.join(LIMITS)}."
            )
        self._strict = {"strict": True} if profile.strict else {}
        super().__init__(
            f"openai:{model}" + (f"@{base_url}" if base_url else ""),
            model,
            host,
            key_variables or profile.keys,
            profile.needs_key or key_variables is not None,
            manner or RequestOptions(),
        )

    def _connect(self, sdk: Any, key: str, common: Mapping[str, Any]) -> Any:
        # From the environment otherwise: OpenAI's account is none of other servers'
        # business. Empty ones are not sent.
        account = None if self._service == "api.openai.com" else ""
        return sdk.OpenAI(
            # The SDK insists on a key; servers of one's own ignore it.
            api_key=key or "none",
            base_url=self._base_url,
            organization=account,
            project=account,
            **common,
        )

    def _send(self, client: Any, request: Request, left: float) -> Any:
        return client.chat.completions.create(**self._arguments(request), timeout=left)

    def _arguments(self, request: Request) -> dict[str, Any]:
        # Cached passages stand first: these services cache equal prefixes by themselves.
        system = "\n\n".join(passage.text for passage in request.system)
        if self._structured == "json_object":
            schema_text = json.dumps(request.schema, ensure_ascii=False)
            system += f"\n\nAnswer with one JSON object that fits this schema:\n{schema_text}"
        arguments: dict[str, Any] = {
            "model": self.model,
            "messages": [
                {"role": "system", "content": system},
                *(_message(message) for message in request.messages),
            ],
            self._limit: self._room(request),
        }
        if self._manner.temperature is not None:
            arguments["temperature"] = self._manner.temperature
        schema = {"name": request.purpose, "schema": request.schema, **self._strict}
        if self._structured == "json_schema":
            arguments["response_format"] = {"type": "json_schema", "json_schema": schema}
        elif self._structured == "tool":
            function = {"name": request.purpose, "parameters": request.schema, **self._strict}
            arguments["tools"] = [{"type": "function", "function": function}]
            arguments["tool_choice"] = {"type": "function", "function": {"name": request.purpose}}
        elif self._structured == "guided_json":
            arguments["extra_body"] = {"nvext": {"guided_json": request.schema}}
        else:
            arguments["response_format"] = {"type": "json_object"}
        return arguments

    def _take_apart(self, answer: Any) -> Written:
        usage = getattr(answer, "usage", None)
        prompt = count(usage, "prompt_tokens")
        cached = min(count(member(usage, "prompt_tokens_details"), "cached_tokens"), prompt)
        choices = getattr(answer, "choices", None) or []
        if not choices or getattr(choices[0], "message", None) is None:
            raise ValueError("the answer holds no choice")
        message, stop = choices[0].message, getattr(choices[0], "finish_reason", None)
        calls = getattr(message, "tool_calls", None) or []
        refusal = getattr(message, "refusal", None)
        return Written(
            model=str(getattr(answer, "model", None) or ""),
            text=str(calls[0].function.arguments if calls else message.content or ""),
            usage=TokenUsage(prompt - cached, cached, 0, count(usage, "completion_tokens")),
            refusal=str(refusal or "") if refusal or stop == "content_filter" else None,
            is_cut=stop == "length",
        )


def _message(message: Message) -> dict[str, Any]:
    if all(isinstance(part, str) for part in message.parts):
        # Small servers know texts only, no lists of parts.
        return {"role": message.role, "content": "\n\n".join(map(str, message.parts))}
    content: list[dict[str, Any]] = []
    for part in message.parts:
        if isinstance(part, PromptPicture):
            data = base64.b64encode(part.data).decode("ascii")
            url = f"data:{part.media_type};base64,{data}"
            content.append({"type": "image_url", "image_url": {"url": url}})
        else:
            content.append({"type": "text", "text": part})
    return {"role": message.role, "content": content}
