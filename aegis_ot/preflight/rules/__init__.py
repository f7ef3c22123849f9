"""What rule files say, as dataclasses, and how JSON is read into them.

Nothing here knows what a protocol is. The files themselves are loaded, and held against the
checks that they name, in :mod:`aegis_ot.preflight.rule_set`.
"""

from .dataclass_reader import hints_of, is_required, parse_json, public_fields, read_dataclass
from .specs import (
    READABLE,
    SCHEMA_VERSION,
    Common,
    Example,
    Examples,
    Family,
    RoleSignal,
    RoleSpec,
    RuleSpec,
    SeriesSpec,
    Shape,
    ShapeSignal,
    Signal,
    role_names,
)

__all__ = [
    "READABLE",
    "SCHEMA_VERSION",
    "Common",
    "Example",
    "Examples",
    "Family",
    "RoleSignal",
    "RoleSpec",
    "RuleSpec",
    "SeriesSpec",
    "Shape",
    "ShapeSignal",
    "Signal",
    "hints_of",
    "is_required",
    "parse_json",
    "public_fields",
    "read_dataclass",
    "role_names",
]
