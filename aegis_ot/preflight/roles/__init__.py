"""What each well is for in the eyes of each assay family, and which family a protocol is of."""

from .assay import Inference, infer_families
from .assigning import assign_roles
from .deriving import derive, implied_contents
from .roles import Roles

__all__ = [
    "Inference",
    "Roles",
    "assign_roles",
    "derive",
    "implied_contents",
    "infer_families",
]
