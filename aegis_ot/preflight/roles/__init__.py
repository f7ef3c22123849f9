"""What each well is for, and why; and which assay it all is.

Door: :func:`gather` finds the clues, :func:`infer_families` weighs the assay families, and
:func:`assign_roles` reads the clues with one family's eyes.
"""

from .assay import Inference, infer_families
from .assigning import assign_roles
from .clues import Clue, Strength
from .contents import implied_contents, settle_diluent
from .deriving import derive
from .gathering import gather
from .roles import Assignment, Roles
from .usage import Usage, usage_of

__all__ = [
    "Assignment",
    "Clue",
    "Inference",
    "Roles",
    "Strength",
    "Usage",
    "assign_roles",
    "derive",
    "gather",
    "implied_contents",
    "infer_families",
    "settle_diluent",
    "usage_of",
]
