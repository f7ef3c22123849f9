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
from ..backend import Message, Picture, Reply, Request, State, Usage
from ..schema import read_answer
from .keys import key_from, one_line, without
from .retrying import Clock, Patience, Trouble, ask_patiently, trouble_of_status

KEY_VARIABLES = ("ANTHROPIC_API_KEY",)
STRUCTURED = ("tool", "output")
_SERVICE = "Anthropic"


class AnthropicBackend:
    """Asks Claude.

    Args:
        model: As Anthropic names it.
        base_url: Another address of the same API (a gateway, a test); ``None``: Anthropic's.
        key: The key; ``None``: from ``ANTHROPIC_API_KEY``.
        structured: ``"tool"`` or ``"output"``.
        patience: How long and how often.
        temperature: Sent if given; newer models refuse it.
        trust_env: Whether the HTTP client may use the proxies of the environment.
        clock: Time.
        output: Longest answer, tokens, instead of what the request says: models that think
            before they answer need room for both.
    """

    def __init__(
        self,
        model: str,
        base_url: str | None = None,
        key: str | None = None,
        structured: str = "tool",
        patience: Patience | None = None,
        temperature: float | None = None,
        trust_env: bool = True,
        clock: Clock | None = None,
        output: int | None = None,
        key_variables: tuple[str, ...] = KEY_VARIABLES,
    ) -> None:
        if structured not in STRUCTURED:
            raise ConfigurationError(
                f"structured={structured!r} is not known for Anthropic; use one of "
                f"{', '.join(STRUCTURED)}."
            )
        self.name = f"anthropic:{model}"
        self.model = model
        self._base_url = base_url
        self._key = key
        self._key_variables = key_variables
        self._structured = structured
        self._patience = patience or Patience()
        self._temperature = temperature
        self._trust_env = trust_env
        self._clock = clock or Clock()
        self._output = output
        self._client: Any = None

    def ask(self, request: Request) -> Reply:
        """Answer one request; see :class:`~aegis_ot.reasoning.backend.Backend`."""
        key = self._key if self._key is not None else key_from(self._key_variables)
        if not key:
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
            message = self._connected(sdk, key).messages.create(
                **self._arguments(request), timeout=left
            )
        except sdk.APITimeoutError:
            raise Trouble(
                State.TIMEOUT, f"{_SERVICE} gave no answer in {self._patience.timeout_s:g} s."
            ) from None
        except sdk.APIConnectionError as error:
            cause = type(error.__cause__ or error).__name__
            raise Trouble(
                State.UNAVAILABLE, f"{_SERVICE} cannot be reached ({cause}).", True
            ) from None
        except sdk.APIStatusError as error:
            said = without(key, one_line(_message_of(error.body) or error.message))
            raise trouble_of_status(
                _SERVICE, error.status_code, said, error.response.headers
            ) from None
        except (sdk.AnthropicError, ValueError, TypeError, AttributeError, KeyError) as error:
            # An answer that the SDK cannot take apart, or a request it will not send.
            said = without(key, one_line(error))
            raise Trouble(State.INVALID, f"{_SERVICE}: {type(error).__name__}: {said}") from None
        return self._read(request, message)

    def _connected(self, sdk: Any, key: str) -> Any:
        if self._client is None:
            self._client = sdk.Anthropic(
                api_key=key,
                base_url=self._base_url,
                max_retries=0,
                http_client=sdk.DefaultHttpxClient(trust_env=self._trust_env),
            )
        return self._client

    def _arguments(self, request: Request) -> dict[str, Any]:
        arguments: dict[str, Any] = {
            "model": self.model,
            "max_tokens": self._output or request.max_output,
            "system": [_passage(p.text, p.cached) for p in request.system],
            "messages": [_message(m) for m in request.messages],
        }
        if self._temperature is not None:
            arguments["temperature"] = self._temperature
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

    def _read(self, request: Request, message: Any) -> Reply:
        usage = _usage(getattr(message, "usage", None))
        model = str(getattr(message, "model", None) or self.model)
        stop = getattr(message, "stop_reason", None)
        blocks = getattr(message, "content", None) or []
        texts = [str(b.text) for b in blocks if getattr(b, "type", "") == "text"]
        calls = [b.input for b in blocks if getattr(b, "type", "") == "tool_use"]
        raw = json.dumps(calls[0], ensure_ascii=False) if calls else "".join(texts)
        if stop == "refusal":
            raise Trouble(
                State.REFUSED,
                f"{model} declined to answer. {one_line(' '.join(texts), 150)}".strip(),
                usage=usage,
                raw=raw,
            )
        if stop in ("max_tokens", "model_context_window_exceeded"):
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
        import anthropic
    except ImportError as error:
        raise Trouble(
            State.UNAVAILABLE,
            f"The package {error.name!r} is not installed; pip install 'aegis-ot[llm]'.",
        ) from None
    return anthropic


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
        if isinstance(part, Picture)
        else {"type": "text", "text": part}
        for part in message.parts
    ]
    return {"role": message.role, "content": content}


def _message_of(body: Any) -> str:
    error = body.get("error") if isinstance(body, Mapping) else None
    return str(error.get("message", "")) if isinstance(error, Mapping) else ""


def _usage(usage: Any) -> Usage:
    def count(name: str) -> int:
        value = getattr(usage, name, None)
        return value if isinstance(value, int) else 0

    return Usage(
        count("input_tokens"),
        count("cache_read_input_tokens"),
        count("cache_creation_input_tokens"),
        count("output_tokens"),
    )
