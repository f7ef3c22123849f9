"""The robot's own server: an HTTP client, runs from a terminal, watch mode, the way onto a robot.

Nothing here runs on the robot. What its server answers, and when, is in Opentrons' HTTP API
reference; see ``docs/how-to/robot.md`` for what is made of it.
"""

from .address import robot_url
from .client import RobotClient
from .server_answers import Analysis, Command, Page, Pipette, RunSnapshot

__all__ = ["Analysis", "Command", "Page", "Pipette", "RobotClient", "RunSnapshot", "robot_url"]
