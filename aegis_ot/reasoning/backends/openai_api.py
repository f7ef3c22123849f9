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
from ..backend import Message, Picture, Reply, Request, State, Usage
from ..schema import read_answer
from .keys import GENERIC, key_from, one_line, without
from .retrying import Clock, Patience, Trouble, ask_patiently, trouble_of_status

STRUCTURED = ("json_schema", "tool", "guided_json", "json_object")
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


class OpenAIBackend:
    """Asks an OpenAI-compatible server.

    Args:
        model: As the server names it.
        base_url: Up to and with ``/v1``; ``None``: OpenAI itself.
        key: The key; ``None``: from the environment, see :data:`PROFILES`. OpenAI's own key goes
            to OpenAI only.
        structured: See :class:`Profile`; ``None``: the profile's.
        limit: Name of the length limit; ``None``: the profile's.
        patience: How long and how often.
        temperature: Sent if given; reasoning models refuse it.
        trust_env: Whether the HTTP client may use the proxies of the environment.
        clock: Time.
        output: Longest answer, tokens, instead of what the request says: models that think
            before they answer need room for both.
        key_variables: Environment variables that may hold the key; ``None``: the profile's.
    """

    def __init__(
        self,
        model: str,
        base_url: str | None = None,
        key: str | None = None,
        structured: str | None = None,
        limit: str | None = None,
        patience: Patience | None = None,
        temperature: float | None = None,
        trust_env: bool = True,
        clock: Clock | None = None,
        output: int | None = None,
        key_variables: tuple[str, ...] | None = None,
    ) -> None:
        self.name = f"openai:{model}" + (f"@{base_url}" if base_url else "")
        self.model = model
        self._base_url = base_url or _OPENAI
        self._host = urlsplit(self._base_url).hostname or self._base_url
        profile = PROFILES.get(self._host, Profile())
        self._structured = structured or profile.structured
        if self._structured not in STRUCTURED:
            raise ConfigurationError(
                f"structured={structured!r} is not known for OpenAI-compatible servers; use one "
                f"of {', '.join(STRUCTURED)}."
            )
        self._limit = limit or profile.limit
        self._key = key
        self._key_variables = key_variables or profile.keys
        self._strict = {"strict": True} if profile.strict else {}
        self._needs_key = profile.needs_key or key_variables is not None
        self._patience = patience or Patience()
        self._temperature = temperature
        self._trust_env = trust_env
        self._clock = clock or Clock()
        self._output = output
        self._client: Any = None

    def ask(self, request: Request) -> Reply:
        """Answer one request; see :class:`~aegis_ot.reasoning.backend.Backend`."""
        key = self._key if self._key is not None else key_from(self._key_variables)
        if not key and self._needs_key:
            return Reply(
                State.NO_KEY,
                self.model,
                detail=f"Set {' or '.join(self._key_variables)} to ask {self.name}.",
                attempts=0,
            )
        return ask_patiently(
            lambda left: self._attempt(request, key, left), self.model, self._patience, self._clock
        )

    def _attempt(self, request: Request, key: str, left: float) -> Reply:
        sdk = _sdk()
        try:
            answer = self._connected(sdk, key).chat.completions.create(
                **self._arguments(request), timeout=left
            )
        except sdk.APITimeoutError:
            raise Trouble(
                State.TIMEOUT, f"{self._host} gave no answer in {self._patience.timeout_s:g} s."
            ) from None
        except sdk.APIConnectionError as error:
            cause = type(error.__cause__ or error).__name__
            raise Trouble(
                State.UNAVAILABLE, f"{self._host} cannot be reached ({cause}).", True
            ) from None
        except sdk.APIStatusError as error:
            said = without(key, one_line(error.message))
            raise trouble_of_status(
                self._host, error.status_code, said, error.response.headers
            ) from None
        except (sdk.OpenAIError, ValueError, TypeError, AttributeError, KeyError) as error:
            # An answer that the SDK cannot take apart, or a request it will not send.
            said = without(key, one_line(error))
            raise Trouble(State.INVALID, f"{self._host}: {type(error).__name__}: {said}") from None
        return self._read(request, answer)

    def _connected(self, sdk: Any, key: str) -> Any:
        if self._client is None:
            self._client = sdk.OpenAI(
                # The SDK insists on one; servers of one's own ignore it.
                api_key=key or "none",
                base_url=self._base_url,
                # From the environment otherwise: OpenAI's account is none of other servers'
                # business. Empty ones are not sent.
                organization="" if self._host != "api.openai.com" else None,
                project="" if self._host != "api.openai.com" else None,
                max_retries=0,
                http_client=sdk.DefaultHttpxClient(trust_env=self._trust_env),
            )
        return self._client

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
            self._limit: self._output or request.max_output,
        }
        if self._temperature is not None:
            arguments["temperature"] = self._temperature
        schema = {"name": request.purpose, "schema": request.schema, **self._strict}
        if self._structured == "json_schema":
            arguments["response_format"] = {"type": "json_schema", "json_schema": schema}
        elif self._structured == "tool":
            function = {
                "name": request.purpose,
                "parameters": request.schema,
                **self._strict,
            }
            arguments["tools"] = [{"type": "function", "function": function}]
            arguments["tool_choice"] = {"type": "function", "function": {"name": request.purpose}}
        elif self._structured == "guided_json":
            arguments["extra_body"] = {"nvext": {"guided_json": request.schema}}
        else:
            arguments["response_format"] = {"type": "json_object"}
        return arguments

    def _read(self, request: Request, answer: Any) -> Reply:
        usage = _usage(getattr(answer, "usage", None))
        model = str(getattr(answer, "model", None) or self.model)
        choices = getattr(answer, "choices", None) or []
        if not choices or getattr(choices[0], "message", None) is None:
            raise Trouble(State.INVALID, f"{self._host} gave an answer without a choice.")
        message, stop = choices[0].message, getattr(choices[0], "finish_reason", None)
        calls = getattr(message, "tool_calls", None) or []
        content = str(getattr(message, "content", None) or "")
        raw = str(calls[0].function.arguments) if calls else content
        refusal = getattr(message, "refusal", None)
        if refusal or stop == "content_filter":
            raise Trouble(
                State.REFUSED,
                f"{model} declined to answer. {one_line(refusal, 150)}".strip(),
                usage=usage,
                raw=raw,
            )
        if stop == "length":
            raise Trouble(
                State.TRUNCATED,
                f"{model} did not finish within {self._output or request.max_output} tokens.",
                usage=usage,
                raw=raw,
            )
        value, problem = read_answer(raw, request.schema)
        if value is None:
            raise Trouble(
                State.INVALID, f"{model} gave an answer that {problem}.", usage=usage, raw=raw
            )
        return Reply(State.ANSWERED, model, value, usage=usage, raw=raw)


def _sdk() -> Any:
    try:
        import openai
    except ImportError as error:
        raise Trouble(
            State.UNAVAILABLE,
            f"The package {error.name!r} is not installed; pip install 'aegis-ot[llm]'.",
        ) from None
    return openai


def _message(message: Message) -> dict[str, Any]:
    if all(isinstance(part, str) for part in message.parts):
        # Small servers know texts only, no lists of parts.
        return {"role": message.role, "content": "\n\n".join(map(str, message.parts))}
    content: list[dict[str, Any]] = []
    for part in message.parts:
        if isinstance(part, Picture):
            data = base64.b64encode(part.data).decode("ascii")
            url = f"data:{part.media_type};base64,{data}"
            content.append({"type": "image_url", "image_url": {"url": url}})
        else:
            content.append({"type": "text", "text": part})
    return {"role": message.role, "content": content}


def _usage(usage: Any) -> Usage:
    def member(holder: Any, name: str) -> Any:
        # Older SDKs leave members that they do not know as plain mappings.
        return holder.get(name) if isinstance(holder, Mapping) else getattr(holder, name, None)

    def count(holder: Any, name: str) -> int:
        value = member(holder, name)
        return value if isinstance(value, int) else 0

    prompt = count(usage, "prompt_tokens")
    cached = min(count(member(usage, "prompt_tokens_details"), "cached_tokens"), prompt)
    return Usage(prompt - cached, cached, 0, count(usage, "completion_tokens"))
