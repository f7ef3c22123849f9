"""The sidecar: the workstation's half of Layer 2. Door: :func:`create_app`, :func:`serve`."""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from .analysers import make_analyser, make_detector
    from .analysis import Analyser, Evidence, Judged, RunAnalyser
    from .app import create_app
    from .auditing import Auditor
    from .config import SidecarConfig
    from .server import running_sidecar, serve

__getattr__ = door(
    __name__,
    {
        "Analyser": "analysis",
        "Auditor": "auditing",
        "Evidence": "analysis",
        "Judged": "analysis",
        "RunAnalyser": "analysis",
        "SidecarConfig": "config",
        "create_app": "app",
        "make_analyser": "analysers",
        "make_detector": "analysers",
        "running_sidecar": "server",
        "serve": "server",
    },
)

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
