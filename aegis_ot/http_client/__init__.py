"""HTTP for the robot half, with the standard library alone: waits end at a deadline or a stop."""

from .client import HttpClient
from .interruptible_socket import SLICE_S, CheckStop

__all__ = ["SLICE_S", "CheckStop", "HttpClient"]
