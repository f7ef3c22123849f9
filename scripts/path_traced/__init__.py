"""The simulated scenes path-traced with Mitsuba: ``python -m scripts.path_traced --help``."""
