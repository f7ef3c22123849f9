"""What a qualification delivers and plants: drawn from a seed, opened after the run."""

from __future__ import annotations

import ast
import hashlib
import json
import math
import random
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass

from ..errors import ConfigurationError
from ..planted import AIR, LEFT, MORE, NO_TIP, NORMAL, NOTHING

CALIBRATING = 6
"""Normal deliveries with which each half of a liquid begins: a run is calibrated on so many."""

HALVES = 2
"""Each liquid is delivered in two: what is learned from one can be tried on the other."""

_MORE = 0.25

CYCLE: tuple[tuple[str, float], ...] = (
    *((LEFT, share) for share in (0.1, 0.2, 0.3, 0.4, 0.5, 0.75, 1.0)),
    *((NOTHING, 0.0), (NOTHING, 0.0), (AIR, 0.1), (MORE, _MORE), (NO_TIP, 0.0)),
)
"""What is planted, again and again until half of a liquid's deliveries are faults."""

SECONDS_EACH = 37.5
"""Of robot time for one delivery, with its tip and its frames; what 30 minutes are divided by."""

MOST = 96
_SOURCE_UL, _PLATE_UL = 11_700.0, 340.0
"""What can be drawn from a well of the reservoir, and what one of the plate takes, µL."""

_RACKS = {
    "p10": ("opentrons_96_tiprack_10ul", 6.0),
    "p20": ("opentrons_96_tiprack_20ul", 12.0),
    "p50": ("opentrons_96_tiprack_300ul", 30.0),
    "p300": ("opentrons_96_tiprack_300ul", 120.0),
    "p1000": ("opentrons_96_tiprack_1000ul", 250.0),
    "flex_1channel_50": ("opentrons_flex_96_tiprack_50ul", 30.0),
    "flex_1channel_1000": ("opentrons_flex_96_tiprack_1000ul", 250.0),
}
"""Tip rack and volume, µL, by pipette."""


@dataclass(frozen=True)
class QualifyingDelivery:
    """One delivery, and what is planted in it.

    Attributes:
        liquid: Its name.
        well: Of the plate.
        half: Of its liquid's deliveries, 1 or 2.
        kind: One of :data:`aegis_ot.planted.KINDS`.
        share: Of the volume: what stays, is air, or is drawn beyond; 0 where it means nothing.
    """

    liquid: str
    well: str
    half: int = 1
    kind: str = NORMAL
    share: float = 0.0

    @property
    def fault(self) -> str:
        """As the simulated camera takes it, without its place."""
        if self.kind == LEFT:
            return "no_dispense" if self.share >= 1 else f"partial:{100 * (1 - self.share):g}"
        percent = f"{100 * self.share:g}"
        return {
            NORMAL: "", NOTHING: "no_aspirate", AIR: f"air_bubble:{percent}",
            MORE: f"overdraw:{percent}", NO_TIP: "no_tip",
        }[self.kind]  # fmt: skip

    @property
    def failure_type(self) -> str:
        """As data sets have it; empty for a normal delivery."""
        if self.kind == LEFT:
            exact = {0.75: "partial_25", 0.5: "partial_50", 0.25: "partial_75", 1.0: "no_dispense"}
            return exact.get(self.share, "partial_single")
        return {
            NORMAL: "", NOTHING: "no_aspirate", AIR: "air_bubble", MORE: "partial_single",
            NO_TIP: "no_tip",
        }[self.kind]  # fmt: skip

    @property
    def leftover(self) -> float | None:
        """Share of the commanded volume that is left in the tip; ``None`` where none is."""
        return self.share if self.kind in (LEFT, MORE) else None


@dataclass(frozen=True)
class QualificationPlan:
    """A whole qualification.

    Attributes:
        seed: Of the order.
        pipette, mount: Opentrons' name, ``"left"`` or ``"right"``.
        tips: Load name of the rack.
        volume_ul: Commanded, of each delivery.
        deliveries: In order.
    """

    seed: int
    pipette: str
    mount: str
    tips: str
    volume_ul: float
    deliveries: tuple[QualifyingDelivery, ...]

    @property
    def is_flex(self) -> bool:
        return self.pipette.startswith("flex")

    @property
    def liquids(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(each.liquid for each in self.deliveries))

    def faults(self) -> tuple[str, ...]:
        """For the simulated camera."""
        return tuple(
            f"{each.fault}@#{number}"
            for number, each in enumerate(self.deliveries, 1)
            if each.fault
        )

    def to_json(self) -> str:
        """One line; what ``planted`` needs stands in it as pairs."""
        pairs = [(each.kind, each.share) for each in self.deliveries]
        wells = [(each.liquid, each.well, each.half) for each in self.deliveries]
        return json.dumps(asdict(self) | {"deliveries": pairs, "wells": wells})

    @classmethod
    def from_json(cls, text: str) -> QualificationPlan:
        """Read what :meth:`to_json` wrote."""
        told = json.loads(text)
        rows = zip(told.pop("wells"), told["deliveries"], strict=True)
        told["deliveries"] = tuple(QualifyingDelivery(*where, *what) for where, what in rows)
        return cls(**told)

    @property
    def digest(self) -> str:
        """SHA-256 of the plan."""
        return hashlib.sha256(self.to_json().encode()).hexdigest()

    @property
    def mark(self) -> str:
        """By which a run of this plan is known: its protocol's name has it."""
        return self.digest[:12]


def make_plan(
    pipette: str,
    mount: str,
    liquids: Sequence[str],
    minutes: float = 30.0,
    seed: int | None = None,
    volume_ul: float | None = None,
    tips: str | None = None,
) -> QualificationPlan:
    """Draw a plan.

    Args:
        pipette: Opentrons' name of a pipette with one channel.
        mount: ``"left"`` or ``"right"``.
        liquids: Their names, one after another; each has deliveries of its own.
        minutes: Of robot time.
        seed: Of the order; drawn if left out.
        volume_ul, tips: Instead of what is usual for the pipette.

    Raises:
        ConfigurationError: It is no such pipette, or there is too little time, plate or liquid.
    """
    short = re.sub(r"_(single|gen2)", "", pipette)
    if short not in _RACKS:
        raise ConfigurationError(
            f"{pipette!r} cannot be qualified: name a pipette with one channel, as "
            "p300_single_gen2 or flex_1channel_1000. Others have to be watched as they are."
        )
    rack, usual = _RACKS[short]
    if not liquids or len(set(liquids)) < len(liquids):
        raise ConfigurationError("Name each liquid once, as in --liquid dye --liquid water.")
    for name in (*liquids, tips or rack):
        if not name.strip() or not name.isprintable() or set(name) & set('"\\'):
            raise ConfigurationError(
                f"{name!r} cannot stand in a protocol: name liquids and tips in plain words, "
                "without double quotes, backslashes and line breaks."
            )
    if not math.isfinite(minutes):
        raise ConfigurationError(f"{minutes} is no time that a robot can take (--minutes).")
    each = min(int(minutes * 60 / SECONDS_EACH), MOST) // len(liquids)
    least = 2 * HALVES * CALIBRATING  # half of them faults
    if each < least:
        raise ConfigurationError(
            f"{minutes:g} minutes are {each} deliveries of each liquid, too few to tell anything: "
            f"{least * len(liquids) * SECONDS_EACH / 60:.1f} minutes at least, and a plate of "
            f"{MOST} wells."
        )
    volume = _volume(volume_ul, usual, (short, tips or rack), each)
    seed = random.SystemRandom().randrange(2**31) if seed is None else seed
    rng = random.Random(seed)
    deliveries: list[QualifyingDelivery] = []
    wells = [f"{row}{column}" for column in range(1, 13) for row in "ABCDEFGH"]
    for liquid in liquids:
        for half, order in enumerate(_halves(each, rng), 1):
            for what in order:
                deliveries.append(QualifyingDelivery(liquid, wells[len(deliveries)], half, *what))
    return QualificationPlan(seed, pipette, mount, tips or rack, volume, tuple(deliveries))


def _volume(given: float | None, usual: float, names: tuple[str, str], deliveries: int) -> float:
    """One that pipette, tip and well take with what is planted beyond it."""
    pipette, rack = names
    sizes = [float(size) for size in re.findall(r"(\d+)ul", rack)[-1:]]
    room = min([*sizes, float(re.findall(r"\d+", pipette)[-1])]) / 1.3
    most = math.floor(min(room, _PLATE_UL / (1 + _MORE), _SOURCE_UL / deliveries))
    volume = min(usual, most) if given is None else given
    if not 0 < volume <= most:
        raise ConfigurationError(
            f"{volume:g} µL cannot be delivered {deliveries} times from one well of the reservoir "
            f"into this plate with this pipette and tips: {most} µL at most (--volume)."
        )
    return volume


def _halves(count: int, rng: random.Random) -> list[list[tuple[str, float]]]:
    """Half of all are faults; each half begins with normal ones, and mixes the others."""
    normal = (NORMAL, 0.0)
    faults = sorted((CYCLE[n % len(CYCLE)] for n in range(count // 2)), key=CYCLE.index)
    mixed = []
    for half in range(HALVES):
        # Both halves have every kind, as far as there are two of it, and every other leftover.
        planted = faults[half::HALVES]
        whole = count // HALVES + (half < count % HALVES)
        rest = planted + [normal] * (whole - CALIBRATING - len(planted))
        rng.shuffle(rest)
        mixed.append([normal] * CALIBRATING + rest)
    return mixed


def plan_in(text: str, name: str = "the protocol") -> QualificationPlan:
    """The plan that a qualification's protocol carries; nothing of it is executed.

    Raises:
        ConfigurationError: It carries none.
    """
    try:
        for node in ast.parse(text).body:
            if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "PLAN":
                return QualificationPlan.from_json(ast.literal_eval(node.value))
    except (AttributeError, KeyError, SyntaxError, TypeError, ValueError):
        pass
    raise ConfigurationError(f"{name} is no protocol that aegis-ot qualify wrote: it has no plan.")
