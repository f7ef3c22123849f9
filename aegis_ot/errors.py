"""Every error that ``aegis_ot`` raises on purpose, as one tree.

::

    AegisError
    ├── ConfigurationError       a setting cannot be used; raised inside ``run`` on a robot
    ├── RehearsalError           the protocol could not be rehearsed
    │   └── RehearsalTimeout     it did not end in the time allowed
    ├── RuleError                a rule file is wrong: file, rule and field
    ├── ProtocolRejected         Layer 1 found errors; no tip has moved
    ├── RunAborted               Layer 2 ended the run, as configured
    ├── LinkError                robot and sidecar could not talk
    │   ├── SidecarUnreachable   no answer in time
    │   ├── SidecarRefused       the token or the request was refused
    │   └── SidecarGarbled       the answer made no sense
    ├── RobotError               the robot's server could not do what was asked
    │   ├── RobotUnreachable     no answer in time
    │   └── RobotRefused         it answered, and refused
    ├── FleetError               a fleet could not do what was asked
    │   ├── AgentLost            a robot's agent does not answer any more
    │   └── AgentFailed          it answered that it broke down
    ├── CameraError              no usable frame
    ├── StoreError               the sidecar could not keep what it received
    ├── ModelError               a vision model file cannot be used
    └── DatasetError             a trajectory data set is wrong: row and column
"""

from __future__ import annotations


class AegisError(Exception):
    """Base of every error raised by this package."""


class ConfigurationError(AegisError):
    """A setting cannot be used as given."""


class RehearsalError(AegisError):
    """The protocol could not be rehearsed.

    Attributes:
        line: 1-based source line at which it stopped, if known.
    """

    def __init__(self, message: str, line: int | None = None) -> None:
        super().__init__(message)
        self.line = line


class RehearsalTimeout(RehearsalError):
    """The rehearsal did not end in the time allowed."""


class RuleError(AegisError):
    """A rule file cannot be used; the message names file, rule and field."""


class ProtocolRejected(AegisError):
    """Layer 1 found errors. On a robot it is raised before a tip moves.

    Attributes:
        line: 1-based source line of the first of them, if known.
    """

    def __init__(self, message: str, line: int | None = None) -> None:
        super().__init__(message)
        self.line = line


class RunAborted(AegisError):
    """Layer 2 ended the run, because the failure policy says so."""


class LinkError(AegisError):
    """Robot and sidecar could not talk."""


class SidecarUnreachable(LinkError):
    """The sidecar gave no answer in time."""


class SidecarRefused(LinkError):
    """The sidecar refused the token or the request."""


class SidecarGarbled(LinkError):
    """The sidecar's answer made no sense."""


class RobotError(AegisError):
    """The robot's server could not do what was asked."""


class RobotUnreachable(RobotError):
    """The robot's server gave no answer in time."""


class RobotRefused(RobotError):
    """The robot's server answered, and refused.

    Attributes:
        status: HTTP status.
    """

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status


class FleetError(AegisError):
    """A fleet could not do what was asked."""


class AgentLost(FleetError):
    """A robot's agent does not answer any more; its robot may still move."""


class AgentFailed(FleetError):
    """A robot's agent answered that it broke down."""


class CameraError(AegisError):
    """The camera gave no usable frame."""


class StoreError(AegisError):
    """The sidecar could not keep or read what it received: disk full, not writable, damaged."""


class ModelError(AegisError):
    """A vision model file is missing, damaged or of another version."""


class DatasetError(AegisError):
    """A trajectory data set is wrong; the message lists every row and column."""
