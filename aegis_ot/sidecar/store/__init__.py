"""What the sidecar keeps: SQLite rows, JPEG files, and the signed chain over both.

Door: :class:`Store`; :mod:`.verifying` holds a store to its chain.
"""

from .captures import Captured
from .database import DATABASE
from .runs import SILENT
from .store import Store

__all__ = ["DATABASE", "SILENT", "Captured", "Store"]
