"""The look back after a run (the paper's Layer 3): silent passes, ranked for a person."""

from .auditing import audit_run
from .result import Audit

__all__ = ["Audit", "audit_run"]
