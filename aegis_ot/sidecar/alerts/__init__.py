"""Something went wrong: it is kept with its run, and people are told. Door: :class:`Alerts`."""

from .alerts import Alerts
from .notices import Notice
from .run_trouble import RunTrouble

__all__ = ["Alerts", "Notice", "RunTrouble"]
