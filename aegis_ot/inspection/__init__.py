"""A look, well by well: frames, boxes, columns, scores and routes of a data set or a run."""

from .datasets import inspect_dataset
from .page import inspection_html
from .runs import inspect_run
from .wells import Inspection

__all__ = ["Inspection", "inspect_dataset", "inspect_run", "inspection_html"]
