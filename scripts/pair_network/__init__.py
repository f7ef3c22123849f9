"""A trial: a small network that reads a tip's two free frames side by side.

``python -m scripts.pair_network --help``. Nothing of the product uses it yet: it asks whether a
network that has learned from drawn plates alone ranks wells of another renderer's cameras better
than the judge's own looks do.
"""
