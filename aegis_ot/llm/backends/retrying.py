"""Asks a service again where that may help, for as long as the caller has time.

The SDKs' own retries are switched off: they know neither the caller's deadline nor what to
report. Waits follow ``Retry-After``, else they double from half a second, with jitter so that
many robots do not come back at once.
"""

from __future__ import annotations

import email.utils
import random
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from ..backend import Reply, State, TokenUsage


@dataclass(frozen=True)
class RetryPolicy:
    """How long and how often to ask.

    Attributes:
        timeout_s: From the question to the last word, retries included, s.
        attempts: Most tries.
        first_wait_s: Wait before the second try, s; doubles from there.
        longest_wait_s: No single wait is longer, s; a service that asks for more is given up.
    """

    timeout_s: float = 60.0
    attempts: int = 4
    first_wait_s: float = 0.5
    longest_wait_s: float = 20.0


@dataclass
class BackendError(Exception):
    """One failed try.

    Attributes:
        state: What it amounts to if it stays so.
        detail: One sentence.
        again: Whether asking again may help.
        wait_s: How long the service asks to wait, s; ``None`` if it does not say.
        usage: Tokens that were counted all the same.
        raw: What the model wrote, if anything.
    """

    state: State
    detail: str
    again: bool = False
    wait_s: float | None = None
    usage: TokenUsage = field(default_factory=TokenUsage)
    raw: str = ""


_GRACE = 0.25
"""The SDK's own timeout comes first, and says more, s."""


class Clock:
    """Time, so that tests need not wait."""

    def now(self) -> float:
        """Seconds, monotonic."""
        return time.monotonic()

    def sleep(self, seconds: float) -> None:
        """Wait."""
        time.sleep(seconds)

    def jitter(self) -> float:
        """Factor for a wait, 0.75 to 1.25."""
        return random.uniform(0.75, 1.25)


def ask_patiently(
    attempt: Callable[[float], Reply], model: str, patience: RetryPolicy, clock: Clock
) -> Reply:
    """Call ``attempt`` with the seconds left until it answers or nothing more helps.

    Args:
        attempt: Gives a reply, or raises :class:`BackendError`.
        model: For the reply.
        patience: How long and how often.
        clock: Time.
    """
    start = clock.now()
    usage = TokenUsage()
    tries = 0
    while True:
        tries += 1
        left = patience.timeout_s - (clock.now() - start)
        try:
            reply = _in_time(attempt, max(left, 0.001))
        except BackendError as trouble:
            usage = usage + trouble.usage
            wait = trouble.wait_s
            if wait is None:
                wait = patience.first_wait_s * 2 ** (tries - 1) * clock.jitter()
                wait = min(wait, patience.longest_wait_s)
            left = patience.timeout_s - (clock.now() - start)
            hopeless = not trouble.again or tries >= patience.attempts
            if hopeless or wait > patience.longest_wait_s or wait >= left:
                detail = trouble.detail
                if tries > 1:
                    detail = f"{detail} Asked {tries} times."
                return Reply(
                    trouble.state,
                    model,
                    None,
                    detail,
                    usage,
                    clock.now() - start,
                    tries,
                    trouble.raw,
                )
            clock.sleep(wait)
        else:
            return replace(
                reply, usage=usage + reply.usage, seconds=clock.now() - start, attempts=tries
            )


def _in_time(attempt: Callable[[float], Reply], left: float) -> Reply:
    """``attempt(left)``, given up after ``left`` seconds even if it goes on.

    The SDKs' timeouts run from byte to byte: a server that drips would hold the caller for ever.
    """
    outcome: list[Reply | BaseException] = []

    def work() -> None:
        try:
            outcome.append(attempt(left))
        except BaseException as error:  # handed to the caller's thread
            outcome.append(error)

    thread = threading.Thread(target=work, name="aegis-ot-ask", daemon=True)
    thread.start()
    thread.join(left + _GRACE)
    if not outcome:
        raise BackendError(State.TIMEOUT, "The service did not finish its answer in time.")
    if isinstance(outcome[0], Reply):
        return outcome[0]
    raise outcome[0]


def retry_after(headers: Mapping[str, str] | Any) -> float | None:
    """Seconds to wait by ``retry-after-ms`` or ``Retry-After`` (seconds or a date), or ``None``."""
    try:
        text = headers.get("retry-after-ms")
        if text is not None:
            return max(float(text) / 1000, 0.0)
        text = headers.get("retry-after")
        if text is None:
            return None
        try:
            return max(float(text), 0.0)
        except ValueError:
            moment = email.utils.parsedate_to_datetime(text)
            return max(moment.timestamp() - time.time(), 0.0)
    except (TypeError, ValueError):
        return None


def trouble_of_status(
    service: str, status: int, message: str, headers: Mapping[str, str] | Any
) -> BackendError:
    """What an HTTP status other than 200 means."""
    said = f" ({message})" if message else ""
    if status in (401, 403):
        return BackendError(State.UNAUTHORIZED, f"{service} refused the key, HTTP {status}{said}.")
    if status == 429:
        return BackendError(
            State.RATE_LIMITED, f"{service} limits the rate{said}.", True, retry_after(headers)
        )
    if status in (408, 409) or status >= 500:
        # 529 is Anthropic's "overloaded".
        return BackendError(
            State.UNAVAILABLE,
            f"{service} is not available, HTTP {status}{said}.",
            True,
            retry_after(headers),
        )
    return BackendError(State.BAD_REQUEST, f"{service} cannot serve this, HTTP {status}{said}.")
