"""What a call cost, by a dated table that a user can override (``AEGIS_OT_PRICES``)."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError
from .backend import TokenUsage

VARIABLE = "AEGIS_OT_PRICES"


@dataclass(frozen=True)
class Price:
    """Of one model, per million tokens."""

    input: float
    cached: float
    cache_written: float
    output: float


@dataclass(frozen=True)
class PriceTable:
    """Prices by model name.

    Attributes:
        as_of: Date of the table, ``"2026-06-30"``; of the user's where there is one.
        currency: ``"USD"``.
        prices: By the beginning of a model's name; the longest that fits counts.
    """

    as_of: str
    currency: str
    prices: Mapping[str, Price]

    def price(self, model: str) -> Price | None:
        """Of a model, dated snapshots and provider prefixes (``vendor/model``) included."""
        name = model.lower().rpartition("/")[2]
        fitting = [known for known in self.prices if _fits(name, known.lower())]
        return self.prices[max(fitting, key=len)] if fitting else None

    def cost(self, model: str, usage: TokenUsage) -> float | None:
        """What ``usage`` cost, in :attr:`currency`; ``None`` if the model has no price here."""
        price = self.price(model)
        if price is None:
            return None
        return (
            usage.input * price.input
            + usage.cached * price.cached
            + usage.cache_written * price.cache_written
            + usage.output * price.output
        ) / 1_000_000


def _fits(name: str, known: str) -> bool:
    """``gpt-4o`` is ``gpt-4o-2024-08-06`` and is not ``gpt-4o-mini``."""
    if name == known:
        return True
    rest = name.removeprefix(known)
    return rest != name and rest[0] in "-@:" and rest[1:2].isdigit()


def load_prices(path: str | Path | None = None) -> PriceTable:
    """The shipped table, with the user's prices over it.

    Args:
        path: The user's file; ``None``: the one that ``AEGIS_OT_PRICES`` names, if any.

    Raises:
        ConfigurationError: The user's file cannot be used; says why.
    """
    shipped = resources.files(__package__).joinpath("prices.json").read_text(encoding="utf-8")
    table = _read(json.loads(shipped), "the shipped price table")
    path = path or os.environ.get(VARIABLE, "").strip() or None
    if path is None:
        return table
    try:
        own = _read(json.loads(Path(path).read_text(encoding="utf-8")), f"The price table {path}")
    except (OSError, ValueError) as error:
        raise ConfigurationError(f"The price table {path} cannot be read: {error}.") from error
    if own.currency != table.currency:
        return own
    return PriceTable(own.as_of, own.currency, {**table.prices, **own.prices})


def _read(data: Any, name: str) -> PriceTable:
    try:
        per = float(data.get("per_tokens", 1_000_000)) / 1_000_000
        prices = {str(model): _price(given, per) for model, given in data["models"].items()}
        return PriceTable(str(data["as_of"]), str(data.get("currency", "USD")), prices)
    except (AttributeError, KeyError, TypeError, ValueError, ZeroDivisionError) as error:
        raise ConfigurationError(
            f'{name} is not of the form {{"as_of": DATE, "models": {{NAME: {{"input": N, '
            f'"output": N}}}}}} ({type(error).__name__}: {error}).'
        ) from error


def _price(given: Mapping[str, Any], per: float) -> Price:
    """What is not said costs what plain input costs."""
    plain = float(given["input"])
    values = [
        plain,
        float(given.get("cached", plain)),
        float(given.get("cache_written", plain)),
        float(given["output"]),
    ]
    if any(not 0 <= value < 1e9 for value in values):
        raise ValueError("a price is negative or not a number")
    return Price(*(value / per for value in values))
