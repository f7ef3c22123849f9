"""A model's part in Layer 1: what it gets to know, what of its answer counts.

In this order: a :class:`~aegis_ot.vocabulary.Dossier` is made from the kept reading, the model is
asked elsewhere (:mod:`aegis_ot.llm`), the proposals for roles of its
:class:`~aegis_ot.vocabulary.Opinion` are verified against source and trace, and what is left is
merged into the report. Standard library only.
"""

from .making import make_dossier, rule_text
from .merging import merge, no_answer
from .proposals import quote_problem

__all__ = ["make_dossier", "merge", "no_answer", "quote_problem", "rule_text"]
