"""Whether the camera's view tells anything: frozen, dark, covered, blown out, blurred, misaimed.

Door: :class:`ViewWatch`, which looks at each frame before it is scored.
"""

from .measures import ViewMeasures, measure_view
from .troubles import TroubleKind, ViewTrouble
from .watch import ViewWatch

__all__ = ["TroubleKind", "ViewMeasures", "ViewTrouble", "ViewWatch", "measure_view"]
