"""The rules in force: the shipped ones, compiled, and a laboratory's own, read and validated."""

from .loading import load_family, load_rules, read_shipped, shipped_rules
from .rule_set import RuleSet

__all__ = ["RuleSet", "load_family", "load_rules", "read_shipped", "shipped_rules"]
