"""The simulation room: a camera that shows a simulated pipette, and planted faults."""

from .camera import SimulatedCamera
from .dyes import Dye, dye_for
from .fault_plan import FaultPlan, PhysicalState
from .faults import Fault, FaultKind, parse_faults
from .render import render, render_jpeg
from .scene import SceneState, TipContent, place_tip
from .session import SessionParameters
from .truth import FrameTruth, TipTruth

__all__ = [
    "Dye",
    "Fault",
    "FaultKind",
    "FaultPlan",
    "FrameTruth",
    "PhysicalState",
    "SceneState",
    "SessionParameters",
    "SimulatedCamera",
    "TipContent",
    "TipTruth",
    "dye_for",
    "parse_faults",
    "place_tip",
    "render",
    "render_jpeg",
]
