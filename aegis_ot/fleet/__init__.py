"""Many robots: one agent per robot, on Academy. Neither layer knows of it.

An agent owns one robot's Layer 1 validator and its Layer 2 session; a coordinator gives it
protocols. See ``docs/how-to/fleet.md``.
"""

from .config import FleetConfig
from .coordinator import run_fleet
from .hosting import hold_robots, serve_agents
from .jobs import Job, read_job
from .report import FleetReport

__all__ = [
    "FleetConfig",
    "FleetReport",
    "Job",
    "hold_robots",
    "read_job",
    "run_fleet",
    "serve_agents",
]
