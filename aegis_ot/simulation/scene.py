"""What stands in view in one frame: the tips, what they hold, and where they hang.

Coordinates are those of :mod:`.session`.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..vision.tips import TipGeometry
from ..vocabulary import KeyframeKind
from .dyes import WATER, Dye
from .session import SessionParameters


@dataclass(frozen=True)
class TipContent:
    """What one tip truly holds.

    Attributes:
        present: Whether there is a tip at all.
        liquid_ul: Liquid in it, µL.
        gap_ul: Air enclosed in the column, µL (0: none).
        gap_below_ul: Liquid below that gap, µL.
        film_ul: Liquid left on the wall above the column, µL.
        film_to_ul: Up to where the wall is wet: the volume whose column ended there, µL.
        drop_ul: Drop hanging from the orifice, µL.
    """

    present: bool = True
    liquid_ul: float = 0.0
    gap_ul: float = 0.0
    gap_below_ul: float = 0.0
    film_ul: float = 0.0
    film_to_ul: float = 0.0
    drop_ul: float = 0.0

    @property
    def slugs(self) -> tuple[tuple[float, float], ...]:
        """The pieces of the column as ``(from, to)`` in µL counted from the orifice."""
        if not self.present or self.liquid_ul <= 0:
            return ()
        if self.gap_ul <= 0:
            return ((0.0, self.liquid_ul),)
        below = min(self.gap_below_ul, self.liquid_ul)
        return ((0.0, below), (below + self.gap_ul, self.liquid_ul + self.gap_ul))


@dataclass(frozen=True)
class SceneState:
    """What is in view in one frame.

    Attributes:
        kind: Which keyframe: says whether the tip is in a well or raised above it.
        tip: Geometry of the tips.
        contents: What each tip in view truly holds: a column's channels from the back (``A1``) to
            the front, or the twelve of a 96-channel head's front row from the left.
        dye: The liquid.
        orifice: Where the first channel's tip ends, mm in the scene.
        rim_z: Height below which labware hides the tip, mm; ``None`` if nothing hides it.
        pitch: Step from one channel to the next (x, y), mm.
        row: Row of wells, which shifts the true volume a little (see ``row_offset``).
        tip_name: Which tip it is: each has specks of its own, whatever it holds.
    """

    kind: KeyframeKind
    tip: TipGeometry
    contents: tuple[TipContent, ...]
    dye: Dye = WATER
    orifice: tuple[float, float, float] = (0.0, 0.0, 40.0)
    rim_z: float | None = None
    pitch: tuple[float, float] = (0.0, -9.0)
    row: str = ""
    tip_name: str = ""


RAISE_MM = 26.0
"""How far above its labware a raised tip hangs, mm (TRANSIT, POST_DISPENSE)."""


def place_tip(
    parameters: SessionParameters,
    kind: KeyframeKind,
    tip: TipGeometry,
    contents: tuple[TipContent, ...],
    dye: Dye = WATER,
    *,
    source: str = "A1",
    destination: str = "A1",
) -> SceneState:
    """The state of a frame from the wells concerned.

    ASPIRATE and DISPENSE are taken with the tip's end inside the well, the others with the tip
    raised, above the destination both times; source wells lie in the first labware, destinations
    in the second. Wells outside the labware's grid are put at its nearest well: the scene has two
    blocks, the deck eleven.
    """
    at_source = kind is KeyframeKind.ASPIRATE
    block = parameters.labware[0 if at_source else 1]
    well = source if at_source else destination
    row, column = well_position(well)
    row = min(row, block.rows - 1)
    x = block.x + (min(column, block.columns - 1) - (block.columns - 1) / 2) * 108 / block.columns
    y = block.y - (row - (block.rows - 1) / 2) * 72 / block.rows
    pitch = (0.0, -9.0)
    if len(contents) > 12:
        # A full 96-channel head: from the front only its front row can be seen.
        contents = contents[7::8]
    if len(contents) > 8:
        x, y, pitch = block.x - 49.5, block.y - 31.5, (9.0, 0.0)
    elif len(contents) > 1:
        # The first tip stands over its row; a whole column's always over the back one.
        y = block.y + 31.5 - 9.0 * min(row, 8 - len(contents))
    inside = kind in (KeyframeKind.ASPIRATE, KeyframeKind.DISPENSE)
    # Shallow wells end sooner; a third of the tip at most is ever hidden.
    depth = min(block.height_mm - 3.0, 9.0, tip.length_mm / 4)
    z = block.height_mm + (-depth if inside else RAISE_MM)
    return SceneState(
        kind=kind,
        tip=tip,
        contents=contents,
        dye=dye,
        orifice=(x, y, z),
        rim_z=block.height_mm if inside else None,
        pitch=pitch,
        row=well[:1],
    )


def well_position(well: str) -> tuple[int, int]:
    """Row and column of a well name, both from 0: ``"B3"`` gives ``(1, 2)``.

    Names of another form count as ``A1``: where a tip is drawn must not fail a run.
    """
    letters = well.rstrip("0123456789")
    digits = well[len(letters) :]
    if not digits or not letters.isalpha():
        return 0, 0
    row = 0
    for letter in letters.upper():
        row = row * 26 + ord(letter) - 64
    return row - 1, max(int(digits) - 1, 0)
