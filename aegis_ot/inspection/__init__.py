"""A look, well by well: frames, boxes, columns, scores and routes of a data set or a run."""

from ..run_view import Inspection
from .page import inspection_html
from .runs import inspect_run

__all__ = ["Inspection", "inspect_run", "inspection_html"]
