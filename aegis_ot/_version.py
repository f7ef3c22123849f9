"""The package's version, read by hatchling and by :mod:`aegis_ot`."""

__version__ = "0.1.0"
