"""The robot's own server: an HTTP client, runs from a terminal, watch mode, the way onto a robot.

Nothing here runs on the robot. What its server answers, and when, is in Opentrons' HTTP API
reference; see ``docs/how-to/robot.md`` for what is made of it.
"""

from .client import RobotClient
from .server_answers import Analysis, Command

__all__ = ["Analysis", "Command", "RobotClient"]
