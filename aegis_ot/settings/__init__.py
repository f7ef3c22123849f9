"""Settings of the guard. Door: :func:`load_settings`, :class:`Settings`."""

from .fields import NAMES, Settings
from .sources import PREFIX, load_settings

__all__ = ["NAMES", "PREFIX", "Settings", "load_settings"]
