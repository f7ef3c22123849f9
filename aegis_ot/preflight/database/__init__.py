"""The rule database: its files and their validation."""

from .files import load_database, load_family, shipped_rules

__all__ = ["load_database", "load_family", "shipped_rules"]
