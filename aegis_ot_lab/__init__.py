"""What makes and measures aegis_ot: evaluation, the paper's reproduction, training, data sets.

A laboratory that guards its robots needs none of it. ``aegis_ot`` never imports it: its commands
join by the entry points of ``pyproject.toml`` (docs/decisions/0007).
"""
