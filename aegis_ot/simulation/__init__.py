"""The simulation room: a camera that shows a simulated pipette, and planted faults."""

from .camera import SimulatedCamera
from .render import render_jpeg
from .scene import place_tip
from .session import SessionParameters
from .truth import FrameTruth, TipTruth

__all__ = [
    "FrameTruth",
    "SessionParameters",
    "SimulatedCamera",
    "TipTruth",
    "place_tip",
    "render_jpeg",
]
