"""What asking a service through its SDK has in common, whichever service it is.

A service's own file says how a request is put to it and how its answer is taken apart; keys,
patience, the meaning of errors and the check of the answer are here, once.
"""

from __future__ import annotations

import importlib
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ...vocabulary import one_line
from ..backend import Reply, Request, State, TokenUsage
from ..schema import read_answer
from .keys import is_sendable, key_from, without
from .retrying import BackendError, Clock, RetryPolicy, ask_patiently, trouble_of_status


@dataclass(frozen=True)
class RequestOptions:
    """How to ask, whoever is asked.

    Attributes:
        key: The key; ``None``: from the environment.
        patience: How long and how often.
        temperature: Sent if given; newer models refuse it.
        trust_env: Whether the HTTP client may use the proxies of the environment.
        clock: Time.
        output: Longest answer, tokens, instead of what the request says: models that think
            before they answer need room for both.
    """

    key: str | None = field(default=None, repr=False)
    patience: RetryPolicy = field(default_factory=RetryPolicy)
    temperature: float | None = None
    trust_env: bool = True
    clock: Clock = field(default_factory=Clock)
    output: int | None = None


@dataclass(frozen=True)
class Written:
    """A service's answer, taken apart.

    Attributes:
        model: Which model wrote it, as the service names it.
        text: What it wrote.
        usage: Tokens.
        refusal: The words with which it declined, ``None`` if it did not.
        is_cut: Whether it ran into the limit of its length.
    """

    model: str
    text: str
    usage: TokenUsage
    refusal: str | None = None
    is_cut: bool = False


class ServiceBackend(ABC):
    """Asks one model of one service. See the subclasses.

    Args:
        name: As the user named it.
        model: As the service names it.
        service: What to call the service in messages.
        key_variables: Environment variables that may hold the key.
        needs_key: Whether asking without a key is pointless.
        manner: How to ask.
    """

    package: str
    """Name of the SDK."""

    def __init__(
        self,
        name: str,
        model: str,
        service: str,
        key_variables: tuple[str, ...],
        needs_key: bool,
        manner: RequestOptions,
    ) -> None:
        self.name = name
        self.model = model
        self._service = service
        self._key_variables = key_variables
        self._needs_key = needs_key
        self._manner = manner
        self._client: Any = None

    def ask(self, request: Request) -> Reply:
        """Answer one request; see :class:`~aegis_ot.llm.backend.Backend`."""
        problem = self.key_problem()
        if problem:
            return self._without_asking(State.NO_KEY, problem)
        key = self._key()
        try:
            # Loading an SDK takes a second or more, which is not the service's.
            sdk = _sdk(self.package)
        except BackendError as trouble:
            return self._without_asking(trouble.state, trouble.detail)
        return ask_patiently(
            lambda left: self._attempt(sdk, request, key, left),
            self.model,
            self._manner.patience,
            self._manner.clock,
        )

    def key_problem(self) -> str:
        """What is wrong with the key, and what to do; empty if it can be used."""
        key = self._key()
        if not key and self._needs_key:
            return f"Set {' or '.join(self._key_variables)} to ask {self.name}."
        if key and not is_sendable(key):
            return (
                f"What {' or '.join(self._key_variables)} holds is no key: it has spaces, line "
                "ends or letters that no key has. Copy it again."
            )
        return ""

    def _key(self) -> str:
        return key_from(self._key_variables) if self._manner.key is None else self._manner.key

    def _without_asking(self, state: State, detail: str) -> Reply:
        return Reply(state, self.model, detail=detail, attempts=0)

    @abstractmethod
    def _connect(self, sdk: Any, key: str, common: Mapping[str, Any]) -> Any:
        """A client of the SDK, with these arguments among others."""

    @abstractmethod
    def _send(self, client: Any, request: Request, left: float) -> Any:
        """Put the request to the service; ``left`` is how long it may take, s."""

    @abstractmethod
    def _take_apart(self, answer: Any) -> Written:
        """What the service sent; raises whatever it likes where that makes no sense."""

    def _room(self, request: Request) -> int:
        """Longest answer, tokens."""
        return self._manner.output or request.max_output

    def _attempt(self, sdk: Any, request: Request, key: str, left: float) -> Reply:
        try:
            if self._client is None:
                self._client = self._connect(sdk, key, self._common(sdk))
            written = self._take_apart(self._send(self._client, request, left))
        except sdk.APITimeoutError:
            patience_s = self._manner.patience.timeout_s
            raise BackendError(
                State.TIMEOUT, f"{self._service} gave no answer in {patience_s:g} s."
            ) from None
        except sdk.APIConnectionError as error:
            cause = type(error.__cause__ or error).__name__
            raise BackendError(
                State.UNAVAILABLE, f"{self._service} cannot be reached ({cause}).", True
            ) from None
        except sdk.APIStatusError as error:
            said = one_line(without(key, _message_of(error.body) or error.message))
            raise trouble_of_status(
                self._service, error.status_code, said, error.response.headers
            ) from None
        except Exception as error:
            # SDKs hand on what a server sends without looking at it: anything may come up.
            said = one_line(without(key, str(error)))
            raise BackendError(
                State.INVALID, f"{self._service}: {type(error).__name__}: {said}"
            ) from None
        return self._judged(request, written)

    def _common(self, sdk: Any) -> Mapping[str, Any]:
        # No redirects: another address would be sent the protocol, and may be sent the key.
        client = sdk.DefaultHttpxClient(trust_env=self._manner.trust_env, follow_redirects=False)
        return {"max_retries": 0, "http_client": client}

    def _judged(self, request: Request, written: Written) -> Reply:
        """The reply, if the answer is whole and fits its form."""
        model = one_line(written.model, 100) or self.model
        usage, raw = written.usage, written.text
        value: dict[str, Any] | None = None
        if written.refusal is not None:
            state = State.REFUSED
            problem = f"{model} declined to answer. {one_line(written.refusal, 150)}".strip()
        elif written.is_cut:
            state = State.TRUNCATED
            problem = f"{model} did not finish within {self._room(request)} tokens."
        else:
            state = State.INVALID
            value, problem = read_answer(raw, request.schema)
            problem = f"{model} gave an answer that cannot be used: {problem}."
        if value is None:
            raise BackendError(state, problem, usage=usage, raw=raw)
        return Reply(State.ANSWERED, model, value, usage=usage, raw=raw)


def _sdk(package: str) -> Any:
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise BackendError(
            State.UNAVAILABLE,
            f"The package {error.name!r} is not installed; pip install 'aegis-ot[llm]'.",
        ) from None


def _message_of(body: Any) -> str:
    """Of an error's body; one SDK hands on all of it, the other its member ``error``."""
    inner = body.get("error", body) if isinstance(body, Mapping) else None
    return str(inner.get("message", "")) if isinstance(inner, Mapping) else ""


def count(holder: Any, name: str) -> int:
    """A number of tokens as a service says it; what it does not say is 0."""
    value = member(holder, name)
    return value if isinstance(value, int) and not isinstance(value, bool) else 0


def member(holder: Any, name: str) -> Any:
    """Older SDKs leave members that they do not know as plain mappings."""
    return holder.get(name) if isinstance(holder, Mapping) else getattr(holder, name, None)
