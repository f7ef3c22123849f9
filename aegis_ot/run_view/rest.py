"""What is told of a run that stopped: its deliveries, what wells and tips hold."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel

Standing = Literal["done", "open", "look"]


class RehearsedDelivery(BaseModel):
    """A delivery that a protocol makes, as its rehearsal tells.

    Attributes:
        wells: What it delivers into, ``"3:A1"``; none where the protocol itself gives it up.
        sources: What it draws from, likewise; empty where nobody told.
        volume_ul: For each tip; ``None`` where nobody told.
        channels: How many tips make it.
    """

    wells: list[str]
    sources: list[str] = []
    volume_ul: float | None = None
    channels: int = 1


class RestDelivery(RehearsedDelivery):
    """One of them, and how it stands.

    Attributes:
        number: Counted over the protocol's own deliveries.
        standing: ``done``: it passed, or was put right. ``open``: its well got nothing, by the
            robot's own word. ``look``: nobody can say what is in the well.
        why: Of one to look at: in a few words.
        tips: The tips that the run used for it.
    """

    number: int
    standing: Standing
    why: str = ""
    tips: list[str] = []


class HeldWell(BaseModel):
    """What a well holds now, as far as the record tells.

    Attributes:
        well: ``"3:A1"``.
        began_ul: What it held before the run; ``None`` where nobody told.
        least_ul, most_ul: What it holds now; without ``began_ul`` the change.
    """

    well: str
    began_ul: float | None = None
    least_ul: float
    most_ul: float


class UsedTip(BaseModel):
    """A tip that the run used.

    Attributes:
        tip: ``"1:A1"``.
        pipette, mount: What it was on.
        deliveries: How many it was used for.
        holds_ul: What it should hold where it was last seen; 0 for an emptied one.
        of: The wells that this was drawn from.
    """

    tip: str
    pipette: str
    mount: str
    deliveries: int = 0
    holds_ul: float = 0.0
    of: list[str] = []


class Rest(BaseModel):
    """All of it.

    Attributes:
        run: Its name.
        ended: How it ended; ``""`` while it goes on.
        deliveries: In the protocol's order.
        wells: In the order in which they were met.
        tips: Likewise.
        warnings: Why some of it may not be so.
    """

    run: str
    ended: str
    deliveries: list[RestDelivery]
    wells: list[HeldWell]
    tips: list[UsedTip]
    warnings: list[str] = []
