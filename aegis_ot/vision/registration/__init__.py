"""Where a camera stands: fitted to the places at which the robot held a tip, and used to say where
each later tip must appear."""

from .fitting import fit
from .locating import Located, TipLocator
from .pinhole import CameraModel
from .registered import ProjectedTip, Registration, Sighting

__all__ = [
    "CameraModel",
    "Located",
    "ProjectedTip",
    "Registration",
    "Sighting",
    "TipLocator",
    "fit",
]
