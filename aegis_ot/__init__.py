"""Guards Opentrons robots: ``from aegis_ot import guard``, then ``@guard`` on ``run``."""

from ._version import __version__
from .guard import guard

__all__ = ["__version__", "guard"]
