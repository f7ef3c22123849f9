"""The package's version, read by hatchling and by :mod:`aegis_ot`."""

__version__ = "0.1.0"

DOCUMENTATION = "https://aegis-ot.readthedocs.io/en/latest/"
"""Where the documentation is read; ``mkdocs.yml`` names it as well."""
