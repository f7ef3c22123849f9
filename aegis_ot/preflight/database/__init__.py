"""The rule database: its files, their validation, their published schema."""

from .files import load_database, load_family, shipped_rules
from .schema import family_schema, schema_text

__all__ = ["family_schema", "load_database", "load_family", "schema_text", "shipped_rules"]
