"""What rule files say, as dataclasses, and how JSON is read into them.

Nothing here knows what a protocol is. The files themselves are loaded, and held against the
checks that they name, in :mod:`aegis_ot.preflight.database`.
"""

from .common import SCHEMA_VERSION, Common
from .reading import json_schema, read_dataclass
from .specs import (
    Database,
    Example,
    Examples,
    Family,
    RoleSignal,
    RoleSpec,
    RuleSpec,
    SeriesSpec,
    ShapeSignal,
    Signal,
)

__all__ = [
    "SCHEMA_VERSION",
    "Common",
    "Database",
    "Example",
    "Examples",
    "Family",
    "RoleSignal",
    "RoleSpec",
    "RuleSpec",
    "SeriesSpec",
    "ShapeSignal",
    "Signal",
    "json_schema",
    "read_dataclass",
]
