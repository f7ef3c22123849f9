"""The sidecar: the workstation's half of Layer 2. Door: :func:`create_app`, :func:`serve`."""

from .analysers import make_analyser, make_detector
from .analysis import Analyser, Evidence, Judged, RunAnalyser
from .app import create_app
from .auditing import Auditor
from .config import SidecarConfig
from .server import running_sidecar, serve

__all__ = [
    "Analyser",
    "Auditor",
    "Evidence",
    "Judged",
    "RunAnalyser",
    "SidecarConfig",
    "create_app",
    "make_analyser",
    "make_detector",
    "running_sidecar",
    "serve",
]
