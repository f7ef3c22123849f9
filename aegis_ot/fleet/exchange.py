"""Where agents and coordinator meet: in this process, at a Redis server, at an HTTP exchange.

No default leads out of the machine. Academy's own hosted exchange is refused here.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from urllib.parse import urlsplit

from academy.exchange import HttpExchangeFactory, LocalExchangeFactory, RedisExchangeFactory
from academy.exchange.cloud.client import DEFAULT_EXCHANGE_URL
from academy.runtime import RuntimeConfig
from academy.serialize import SerializationStrategy, allowed_deserializers, default_serializer

from ..errors import ConfigurationError

JSON_ONLY = RuntimeConfig(
    default_serializer=SerializationStrategy.JSON,
    allowed_deserializers={SerializationStrategy.JSON},
    max_sync_concurrency=2,
)
"""Of every agent: a pickle from an exchange would run whatever code it holds."""


def make_exchange(address: str) -> Any:
    """A factory of clients of an exchange; see :class:`~.config.FleetConfig` for the address.

    Raises:
        ConfigurationError: It is none of the three kinds.
    """
    if address == "local":
        return LocalExchangeFactory()
    try:
        url = urlsplit(address)
        port = url.port
    except ValueError:
        url, port = urlsplit(""), None
    if url.scheme in ("redis", "rediss") and url.hostname:
        options: dict[str, Any] = {"username": url.username, "password": url.password}
        options["ssl"] = url.scheme == "rediss"
        # Listening blocks until a message comes. Redis clients from 8 on would give up within a
        # minute, and Academy ends an agent whose listening ends.
        options["socket_timeout"] = None
        return RedisExchangeFactory(url.hostname, port or 6379, **options)
    if url.scheme in ("http", "https") and url.hostname:
        if url.hostname == urlsplit(DEFAULT_EXCHANGE_URL).hostname:
            raise ConfigurationError(
                "The hosted exchange is not used; run one: aegis-ot fleet exchange."
            )
        return HttpExchangeFactory(address.rstrip("/"))
    raise ConfigurationError(
        f"The exchange {address!r} is none of: local, redis://HOST:PORT, http://HOST:PORT."
    )


@contextmanager
def json_only() -> Iterator[None]:
    """The same for what this task sends and reads."""
    sending = default_serializer.set(SerializationStrategy.JSON)
    reading = allowed_deserializers.set({SerializationStrategy.JSON})
    try:
        yield
    finally:
        default_serializer.reset(sending)
        allowed_deserializers.reset(reading)


def serve_exchange(host: str, port: int) -> None:
    """Run a self-hosted HTTP exchange until it is interrupted.

    It asks nobody who they are: whoever reaches it can have the agents run protocols.
    """
    from academy.exchange.cloud.app import create_app
    from academy.exchange.cloud.config import ExchangeServingConfig
    from aiohttp.web import run_app

    run_app(
        create_app(ExchangeServingConfig(host=host, port=port)), host=host, port=port, print=None
    )
