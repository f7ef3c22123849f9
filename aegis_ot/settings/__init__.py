"""Settings of the guard. Door: :func:`load_settings`, :class:`Settings`."""

from .fields import NAMES, Settings
from .sources import load_settings

__all__ = ["NAMES", "Settings", "load_settings"]
