"""What the guard costs and what Layer 2 sees, measured and printed, never asserted.

``python -m benchmarks`` (``make bench``) runs all; each module yields :class:`~.figure.Figure`.
"""
