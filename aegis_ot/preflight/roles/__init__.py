"""What each well is for, and why; and which assay it all is.

Door: :func:`infer_families` weighs the assay families, :func:`assign_roles` reads the clues with
one family's eyes, and :func:`derive` adds what follows from the liquid's ways.
"""

from .assay import Inference, infer_families
from .assigning import assign_roles
from .contents import implied_contents, settle_diluent
from .deriving import derive
from .roles import Assignment, Roles

__all__ = [
    "Assignment",
    "Inference",
    "Roles",
    "assign_roles",
    "derive",
    "implied_contents",
    "infer_families",
    "settle_diluent",
]
