"""A trial: a small network that reads a tip's two free frames side by side.

``python -m scripts.pair_network --help``. Nothing of the product uses it; what it told on cameras
that nothing was learned from stands in ``docs/how-to/layer2-evaluation.md``.
"""
