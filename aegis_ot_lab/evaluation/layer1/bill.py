"""What asking a model took over a whole evaluation: tokens, time, money."""

from __future__ import annotations

import statistics
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from aegis_ot.llm import PriceTable, Reply, TokenUsage


def cost_of(reply: Reply | None, prices: PriceTable) -> float | None:
    """What one reply cost, in the table's currency.

    ``None`` where that is not known: the model has no price, or an answer came without a count
    of its tokens, as imported ones may.
    """
    if reply is None or (reply.usage == TokenUsage() and not reply.answered):
        return 0.0
    if reply.usage == TokenUsage():
        return None
    return prices.cost(reply.model, reply.usage)


@dataclass(frozen=True)
class Bill:
    """See the module.

    Attributes:
        models: Who answered, as the service names it; who was asked, if nobody did.
        asked: Protocols about which a model was asked.
        answered: Of these, how many got an answer.
        usage: Tokens of all calls.
        median_input: Of the calls whose tokens were counted.
        median_output: Of the calls whose tokens were counted.
        cost: Of all calls; ``None`` if any has no price.
        unpriced: Models that have no price, or whose tokens nobody counted.
        currency: Of the price table.
        as_of: Date of the price table.
    """

    models: tuple[str, ...]
    asked: int
    answered: int
    usage: TokenUsage
    median_input: float
    median_output: float
    cost: float | None
    unpriced: tuple[str, ...]
    currency: str
    as_of: str

    @property
    def cached_share(self) -> float:
        """Share of the input that came from the service's cache, 0 to 1."""
        return self.usage.cached / self.usage.total_input if self.usage.total_input else 0.0

    def to_json(self) -> dict[str, Any]:
        """As plain values; a cost that is not known is ``null``."""
        return {
            "models": list(self.models),
            "asked": self.asked,
            "answered": self.answered,
            "tokens": {
                "input": self.usage.total_input,
                "cached": self.usage.cached,
                "cache_written": self.usage.cache_written,
                "output": self.usage.output,
                "cached_share": round(self.cached_share, 4),
                "median_input": self.median_input,
                "median_output": self.median_output,
            },
            "cost": self.cost,
            "currency": self.currency,
            "prices_as_of": self.as_of,
            "unpriced": list(self.unpriced),
        }

    def lines(self) -> Iterator[str]:
        """For people."""
        yield f"  model     {', '.join(self.models)}: {self.answered} of {self.asked} answered"
        if self.usage.total_input or self.usage.output:
            yield (
                f"  tokens    {self.usage.total_input} in ({self.cached_share:.0%} from the "
                f"cache), {self.usage.output} out; a protocol, median: {self.median_input:.0f} in, "
                f"{self.median_output:.0f} out"
            )
        if self.cost is None:
            yield (
                f"  cost      not known for {', '.join(self.unpriced)}: no price, or no count of "
                "tokens (AEGIS_OT_PRICES=FILE names a table of your own)"
            )
        else:
            yield (
                f"  cost      {self.cost:.3f} {self.currency} by the price table of {self.as_of}; "
                "check your provider"
            )


def bill_of(replies: Sequence[Reply | None], prices: PriceTable) -> Bill | None:
    """Add up; ``None`` if no model was asked.

    Args:
        replies: One per protocol, ``None`` where no model was asked.
        prices: What tokens cost.
    """
    asked = [reply for reply in replies if reply is not None]
    if not asked:
        return None
    costs = [cost_of(reply, prices) for reply in asked]
    counted = [reply.usage for reply in asked if reply.usage != TokenUsage()]
    unpriced = [r.model for r, cost in zip(asked, costs, strict=True) if cost is None]
    known = [cost for cost in costs if cost is not None]
    return Bill(
        models=tuple(dict.fromkeys(r.model for r in [r for r in asked if r.answered] or asked)),
        asked=len(asked),
        answered=sum(reply.answered for reply in asked),
        usage=sum(counted, TokenUsage()),
        median_input=statistics.median([u.total_input for u in counted] or [0]),
        median_output=statistics.median([u.output for u in counted] or [0]),
        cost=None if unpriced else sum(known),
        unpriced=tuple(dict.fromkeys(unpriced)),
        currency=prices.currency,
        as_of=prices.as_of,
    )
