"""A model's part in Layer 1: what it gets to know, what it answers, what of that counts.

In this order: a :class:`Dossier` is made from the kept reading, the model is asked elsewhere,
its :class:`Opinion` is held to what exists, its proposals for roles are verified against
source and trace, and what is left is merged into the report. Standard library only.
"""

from .answers import read_opinion
from .dossier import Dossier
from .making import check_with_dossier, make_dossier, rule_text
from .merging import merge
from .opinion import Citation, Opinion, RoleProposal, RuleAnswer, no_answer
from .proposals import verify_proposals

__all__ = [
    "Citation",
    "Dossier",
    "Opinion",
    "RoleProposal",
    "RuleAnswer",
    "check_with_dossier",
    "make_dossier",
    "merge",
    "no_answer",
    "read_opinion",
    "rule_text",
    "verify_proposals",
]
