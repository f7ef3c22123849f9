"""What each well is for in the eyes of each assay family, and which family a protocol is of."""

from typing import TYPE_CHECKING

from ...lazy import door

if TYPE_CHECKING:
    from .assay import infer_families
    from .assigning import assign_roles
    from .deriving import derive, implied_contents
    from .inference import Inference
    from .naming import FamilyWords
    from .roles import Roles

__getattr__ = door(
    __name__,
    {
        "assay": "infer_families",
        "assigning": "assign_roles",
        "deriving": "derive implied_contents",
        "inference": "Inference",
        "naming": "FamilyWords",
        "roles": "Roles",
    },
)

__all__ = [
    "FamilyWords",
    "Inference",
    "Roles",
    "assign_roles",
    "derive",
    "implied_contents",
    "infer_families",
]
