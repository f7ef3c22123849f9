"""What a person can do about a step that failed and that the robot waits to be recovered from."""

from __future__ import annotations

from ..errors import RobotError
from .client import RobotClient
from .server_answers import Command

RECOVERING = "awaiting-recovery"
"""Run status in which ``play`` does nothing."""


class Recovery:
    """The acts of one run, as the robot understands them in the state that it is in.

    Attributes:
        status: Of the run at the last look.
    """

    def __init__(self, robot: RobotClient, run: str) -> None:
        self._robot = robot
        self._run = run
        self._again = ""
        self.status = ""

    def act(self, wanted: str) -> None:
        """``"play"``, ``"pause"``, ``"stop"``, or ``"retry"``: the failed step once more, and then
        on with the run.

        Raises:
            RobotError: The robot cannot do it now.
        """
        if wanted == "retry":
            if self.status != RECOVERING:
                raise RobotError("No failed step waits to be tried again.")
            self._again = self._robot.try_again(self._run)
        elif wanted == "play" and self.status == RECOVERING:
            self._robot.act(self._run, "resume-from-recovery")
        else:
            self._robot.act(self._run, wanted)

    def failed_again(self, command: Command) -> bool:
        """A command is over. If it was the step that is tried again, the run goes on after it,
        unless it failed once more.

        Raises:
            RobotError: The robot does not go on.
        """
        if not self._again or command.id != self._again:
            return False
        self._again = ""
        if command.status != "succeeded":
            return True
        self._robot.act(self._run, "resume-from-recovery")
        return False
