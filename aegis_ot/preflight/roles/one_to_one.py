"""Wells that each serve wells of their own, and so hold each something of its own."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from ...vocabulary import WellRef
from ..evidence import Strength
from ..rules import Common
from ..text import tokens, words_of
from ..trace import Trace, in_trough
from .roles import Roles

_FEWEST_PAIRS = 3

_SMALLEST_PLATE = 24


def derive_one_to_one(roles: Roles, name: str, trace: Trace) -> None:
    """Wells of a plate that each serve one well of their own hold each something of its own.

    A liquid that stands in several wells (a strip of master mix) serves several wells each.
    """
    served = trace.served(prefilled=True)
    for key, refs in _by_labware(trace, served).items():
        if len(trace.labware[key].wells) < _SMALLEST_PLATE:
            continue
        pairs = all(len(served[ref]) == 1 and not roles.of(ref) for ref in refs)
        into = {well for ref in refs for well in served[ref]}
        if pairs and len(refs) >= _FEWEST_PAIRS and len(into) == len(refs):
            roles.apart.update(refs)
            for ref in refs:
                roles.derived.setdefault(ref, set()).update(roles.closure(name))


def derive_called_apart(roles: Roles, name: str, trace: Trace, common: Common) -> None:
    """Unnamed wells of a rack or plate that have each a name of their own, whatever it means, and
    go into wells of their own: "rhine", "danube".

    Not where names share a word ("oil, first tube"), or say no more than a place or an order:
    one liquid may stand in several tubes.
    """
    dull = words_of((*common.ordinals, *common.places, *common.positions))
    called: dict[WellRef, set[str]] = {}
    for clue in roles.untold:
        if clue.strength in (Strength.NAME, Strength.LIQUID) and len(clue.places) == 1:
            words = {word for word in tokens(clue.text) if word.isalpha()} - dull
            called.setdefault(clue.wells[0], set()).update(words)
    served = trace.served(prefilled=True)
    for refs in _by_labware(trace, served).values():
        said = Counter(word for ref in refs for word in called.get(ref, ()))
        fed = Counter(well for ref in refs for well in served[ref])
        alone = all(called.get(ref) for ref in refs) and max(said.values(), default=2) == 1
        if len(refs) >= _FEWEST_PAIRS and alone and max(fed.values(), default=2) == 1:
            for ref in refs:
                if not roles.of(ref):
                    roles.derived.setdefault(ref, set()).update(roles.closure(name))


def _by_labware(trace: Trace, served: Iterable[WellRef]) -> dict[str, list[WellRef]]:
    """The sources in each plate and rack, by its key; not those in troughs."""
    found: dict[str, list[WellRef]] = {}
    for ref in served:
        if ref.labware in trace.labware and not in_trough(trace, ref.labware):
            found.setdefault(ref.labware, []).append(ref)
    return found
