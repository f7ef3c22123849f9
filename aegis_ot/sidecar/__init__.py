"""The sidecar: the workstation's half of Layer 2. Door: :func:`create_app`, :func:`serve`."""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from .analysers import make_analyser, make_detector
    from .analysis import Analyser, Judged, RunAnalysis
    from .app import create_app
    from .config import SidecarConfig
    from .server import running_sidecar, serve

__getattr__ = door(
    __name__,
    {
        "analysers": "make_analyser make_detector",
        "analysis": "Analyser Judged RunAnalysis",
        "app": "create_app",
        "config": "SidecarConfig",
        "server": "running_sidecar serve",
    },
)

__all__ = [
    "Analyser",
    "Judged",
    "RunAnalysis",
    "SidecarConfig",
    "create_app",
    "make_analyser",
    "make_detector",
    "running_sidecar",
    "serve",
]
