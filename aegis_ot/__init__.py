"""Guards Opentrons robots: ``from aegis_ot import guard``, then ``@guard`` on ``run``.

On a workstation ``aegis_ot.check(path)`` judges a protocol before it runs.
"""

from typing import TYPE_CHECKING

from ._version import __version__
from .guard import guard
from .lazy import door

if TYPE_CHECKING:
    from .workbench.api import check

# The robot loads the guard alone.
__getattr__ = door(__name__, {"workbench.api": "check"})

__all__ = ["__version__", "check", "guard"]
