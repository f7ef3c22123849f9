"""What a column reader gives: liquid in the tip in µL."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class SeenColumn:
    """A column that left the tip, by where its end is seen and not by where it should be.

    Its scale is what the run's own wells showed: an estimate, on which no verdict rests.

    Attributes:
        volume_ul: µL.
        sigma_ul: Standard uncertainty of it, µL.
        top: Its upper end as a fraction of the tip's length above the orifice.
    """

    volume_ul: float
    sigma_ul: float
    top: float


@dataclass(frozen=True)
class ColumnReading:
    """The liquid column in one frame.

    Attributes:
        volume_ul: Liquid in the tip, µL.
        sigma_ul: Standard uncertainty of it, µL.
        top: Upper end of the column as a fraction of the tip's length above the orifice.
        vague: The tip looks empty, but so might a filled one: no proof either way.
        excess: How far the rows above the expected end speak for liquid there, log-likelihood
            ratio; 0: not at all. From 5 on it is believed, and the volume is what is seen; below
            that it is the expected one.
        seen: The column by its own end, where that shows and the run's scale is known.
        tested: How many normal tips of this run were read so before they were learned: what the
            uncertainties rest on.
        unchanged: Whether liquid is what has not changed since TRANSIT: a tip that was empty then
            is taken for a full one.
    """

    volume_ul: float
    sigma_ul: float
    top: float = 0.0
    vague: bool = False
    excess: float = 0.0
    seen: SeenColumn | None = None
    tested: int = 0
    unchanged: bool = False
