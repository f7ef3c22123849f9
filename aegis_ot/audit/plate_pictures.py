"""Two pictures of a plate, from before and after a run, beside what the record says it holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from ..errors import ConfigurationError
from ..vision.plate import (
    LEAST_PITCH_PX,
    FoundPlate,
    PlateFormat,
    PlateLight,
    change_between,
    find_plate,
    other_kind,
    plate_light,
)
from ..vision.types import Image
from .plate_fit import AGREES, CONTRADICTS, ODD, UNJUDGED, PlateReading, WellReading, read_plate
from .plate_record import RecordedPlate
from .plate_words import arrived_words, contradiction_words, doubt_words, unjudged_words

CORNERS = ("top-left", "top-right", "bottom-left", "bottom-right")

_CLEARLY = 3
"""How many times fewer wells must contradict a reading that fits clearly better."""


@dataclass(frozen=True)
class PlatePicture:
    """A picture and the plate in it."""

    name: str
    image: Image
    found: FoundPlate

    @property
    def a1(self) -> str:
        """The corner where A1 is, as found: the grid alone does not tell it from the opposite."""
        return "top-right" if self.found.upright else "top-left"

    def with_a1(self, corner: str) -> PlatePicture:
        """Read with A1 in a corner.

        Raises:
            ConfigurationError: It cannot be there.
        """
        if corner == self.a1:
            return self
        if corner == opposite(self.a1):
            return replace(self, found=self.found.turned())
        lies = "stands upright" if self.found.upright else "lies lengthwise"
        raise ConfigurationError(
            f"--a1 {corner}: in {self.name} the plate {lies}, so A1 is at its {self.a1} or its "
            f"{opposite(self.a1)}."
        )


@dataclass(frozen=True)
class PlateAudit:
    """What two pictures say of a plate.

    Attributes:
        title: The plate, as the record calls it.
        rows, columns: Its size.
        before, after: Names of the pictures.
        a1: The corner of A1 in each, as it was read.
        a1_told: Whether the user said so.
        doubt: Why the pictures are doubted as a whole; then no well is accused. Empty if not.
        wells: What is said of each well, row by row.
        contradictions: Sentences on the wells that contradict the record, the farthest off first.
        notes: Sentences on what could not be judged, and what else must be said.
    """

    title: str
    rows: int
    columns: int
    before: str
    after: str
    a1: tuple[str, str]
    a1_told: bool
    doubt: str
    wells: Sequence[WellReading]
    contradictions: Sequence[str]
    notes: Sequence[str]

    @property
    def stands_out(self) -> bool:
        """Whether a person should look."""
        return bool(self.doubt) or any(
            one.state == CONTRADICTS and not one.why for one in self.wells
        )

    @property
    def to_look_at(self) -> list[str]:
        """Wells that the pictures contradict, then those that look odd and are not accused."""
        contradicting = [one.well for one in self.wells if one.state == CONTRADICTS]
        return contradicting + [one.well for one in self.wells if one.why in ODD]

    def counted(self, state: str) -> int:
        """How many wells are in a state."""
        return sum(one.state == state for one in self.wells)

    def to_json(self) -> dict[str, Any]:
        """Plain values."""
        return asdict(self) | {"stands_out": self.stands_out}


def read_picture(path: Path, plate: PlateFormat) -> PlatePicture:
    """Read a picture and find the plate in it.

    Raises:
        ConfigurationError: It is missing, no picture, or no such plate is found.
    """
    try:
        data = np.fromfile(path, np.uint8)
    except OSError as error:
        raise ConfigurationError(f"--plate: {path} cannot be read: {error.strerror}.") from error
    decoded = cv2.imdecode(data, cv2.IMREAD_COLOR) if data.size else None
    if decoded is None:
        raise ConfigurationError(f"--plate: {path} is no picture that can be read (JPEG, PNG).")
    image = np.asarray(decoded, np.uint8)
    found = find_plate(image, plate)
    other = other_kind(image, found)
    if found is None or other is not None:
        seen = f"It rather looks like one of {other.wells} wells. " if other else ""
        raise ConfigurationError(
            f"--plate: in {path} no plate of {plate.wells} wells is found. {seen}Take the picture "
            "from straight above, the whole plate in it with some of what it stands on, without a "
            "lid, sharp, and with a ground that differs from the plate."
        )
    if found.pitch_px < LEAST_PITCH_PX:
        raise ConfigurationError(
            f"--plate: in {path} the wells are only {found.pitch_px:.0f} px apart; "
            f"{LEAST_PITCH_PX:.0f} are needed. Take the picture from nearer by."
        )
    return PlatePicture(path.name, image, found)


def compare_pictures(
    before: PlatePicture, after: PlatePicture, recorded: RecordedPlate, a1: Sequence[str] = ()
) -> PlateAudit:
    """Compare what changed between two pictures with the record.

    Args:
        before: From before the run.
        after: From after it.
        recorded: The plate by the record.
        a1: The corner of A1, of both pictures or of each; empty if the user did not say.

    Raises:
        ConfigurationError: A1 cannot be in that corner, or it is one picture twice.
    """
    if np.array_equal(before.image, after.image):
        raise ConfigurationError(f"--plate: {before.name} and {after.name} are the same picture.")
    if a1:
        before, after = before.with_a1(a1[0]), after.with_a1(a1[-1])
    corners = (a1[0], a1[-1]) if a1 else (before.a1, after.a1)
    lights = plate_light(before.image, before.found), plate_light(after.image, after.found)
    reading = _read(lights, (False, False), recorded)
    doubt = doubt_words(reading, recorded, before.name, after.name)
    notes = []
    if not a1:
        turned, same = _turned(reading, lights, corners, recorded)
        doubt = turned or doubt
        notes.append(
            f"A1 is taken to be at the {corners[0]} of {before.name} and the {corners[1]} of "
            f"{after.name}." + same
        )
    arrived = [one.well for one in reading.wells if one.state == AGREES and one.why]
    if doubt:
        # Nothing that such pictures say of a well is worth anything, be it good or bad.
        doubted = [WellReading(one.well, UNJUDGED, "doubt") for one in reading.wells]
        reading = replace(reading, wells=doubted)
    else:
        notes += [*([arrived_words(arrived)] if arrived else ()),
                  *unjudged_words(reading, recorded)]  # fmt: skip
    return PlateAudit(
        recorded.title, recorded.plate.rows, recorded.plate.columns, before.name, after.name,
        corners, bool(a1), doubt, reading.wells,
        contradiction_words(reading, recorded), notes,
    )  # fmt: skip


def opposite(corner: str) -> str:
    """The corner opposite."""
    return CORNERS[3 - CORNERS.index(corner)]


def _read(
    lights: tuple[PlateLight, PlateLight], turn: tuple[bool, bool], recorded: RecordedPlate
) -> PlateReading:
    first, second = (
        light.turned() if turned else light for light, turned in zip(lights, turn, strict=True)
    )
    return read_plate(change_between(first, second), recorded)


def _turned(
    reading: PlateReading,
    lights: tuple[PlateLight, PlateLight],
    corners: tuple[str, str],
    recorded: RecordedPlate,
) -> tuple[str, str]:
    """What to say if the record fits clearly better, or as well, with A1 at the other corner."""
    off, judged = reading.contradicting, _judged(reading)
    for turn in ((True, True), (False, True), (True, False)):
        other = _read(lights, turn, recorded)
        better = _CLEARLY * other.contradicting <= off and _judged(other) >= judged
        if off > 1 and better and other.shows:
            ways = [opposite(one) if way else one for one, way in zip(corners, turn, strict=True)]
            said = f"--a1 {ways[0]}" + (f" --a1 {ways[1]}" if ways[0] != ways[1] else "")
            return (
                f"The record fits the pictures clearly better with A1 at the {ways[0]} before and "
                f"at the {ways[1]} after ({other.contradicting} instead of {off} wells contradict "
                f"it): a plate seems to lie turned. Look where A1 is, and say {said} if it is so.",
                "",
            )
        same = _judged(other) >= judged and other.contradicting <= off + 1
        if turn == (True, True) and same and other.shows:
            return "", " The record fits as well with A1 opposite: say with --a1 where it is."
    return "", ""


def _judged(reading: PlateReading) -> int:
    return sum(one.state != UNJUDGED for one in reading.wells)
