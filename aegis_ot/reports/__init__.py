"""One renderer per output. Pure: values in, text out."""

from .dryrun_html import dry_run_html

__all__ = ["dry_run_html"]
