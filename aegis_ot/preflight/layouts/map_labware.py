"""Which labware a plate map speaks of: the one that is called so, or that the run uses it on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...vocabulary import WellRef
from ..rules import Common
from ..text import Place, SourceFacts, origins, tokens, words_of
from .deck import MOST_TUBES, Deck
from .labware_nouns import LabwareNouns
from .well_names import plain_name


def labware_of_map(
    deck: Deck, facts: SourceFacts, name: str, spots: Sequence[str], common: Common
) -> tuple[str, ...]:
    """The labware that a plate map of this name speaks of: the one that is called so, several
    plates where the run uses it on all alike, none where that is not plain.
    """
    owners = (*deck.by_name.items(), *deck.by_label.items())
    called = {key for own, keys in owners if tokens(own) == tokens(name) for key in keys}
    if len(called) == 1:
        return tuple(called)
    used = used_with(deck, facts, name)
    if len(used) > 1:
        in_all = all((key, spot) in deck.refs for key in used for spot in spots)
        sizes = [len(deck.trace.labware[key].wells) for key in used]
        if in_all and min(sizes) <= MOST_TUBES < max(sizes):
            # Tubes, and wells of the same names: of both where each goes into its namesake.
            if _is_stamped(deck, used, spots):
                return used
            alike = called_alike(deck, name, common)
            return (alike,) if alike in used else ()
        used = _alike(deck, used, spots)
    return used or _unused(deck, name, spots, common)


def _unused(deck: Deck, name: str, spots: Sequence[str], common: Common) -> tuple[str, ...]:
    """The one labware that a map speaks of which the run does not use: ``RESERVOIR_MAP``."""
    nouns = LabwareNouns(deck, common)
    called = nouns.named(name) or nouns.kind_in(name)
    if called:
        return tuple(called)
    one = called_alike(deck, name, common) or deck.most_likely(spots)
    return (one,) if one and one in (nouns.of_kinds_in(name) or (one,)) else ()


def _is_stamped(deck: Deck, keys: Sequence[str], spots: Sequence[str]) -> bool:
    """Whether each of these places of one labware is drawn into the same place of another."""
    names = set(map(plain_name, spots))
    copied = {
        source.ref.name
        for source, well, _ in deck.trace.feedings()
        if source.ref.name == well.ref.name
        and source.ref.labware != well.ref.labware
        and {source.ref.labware, well.ref.labware} <= set(keys)
    }
    return names <= copied


def refs_of(deck: Deck, labware: Sequence[str], spots: Iterable[str]) -> Iterator[WellRef]:
    """The wells of these names in each of these labware."""
    names = [plain_name(spot) for spot in spots]
    for key in labware:
        info = deck.trace.labware.get(key)
        for name in names:
            if info is not None and name in info.wells:
                yield deck.ref(key, name)


def used_with(deck: Deck, facts: SourceFacts, name: str) -> tuple[str, ...]:
    """The labware that is indexed by this constant, straight or in a comprehension.

    Best that which is indexed by what stands in it (``for code, tube in TUBES.items()``), then by
    what that leads to (``plate[wells_of[code]]``), then by parts of it (``plate[tube[0] + "3"]``).
    """
    straight: set[str] = set()
    led_to: set[str] = set()
    by_parts: set[str] = set()
    for place in facts.places:
        if name not in origins(facts, place.names, (place.line,)):
            continue
        keys = deck.by_name.get(place.labware) or _listed(deck, facts, place)
        if place.made:
            by_parts |= keys
        elif name in origins(facts, {*place.names} - place.keyed_by, (place.line,), by_keys=False):
            straight |= keys
        else:
            led_to |= keys
    return tuple(sorted(straight or led_to or by_parts))


def _listed(deck: Deck, facts: SourceFacts, place: Place) -> set[str]:
    """The labware that a comprehension takes in turn: ``[rack[name] for rack in racks ...]``."""
    lists = origins(facts, (place.labware,), (place.line,))
    held = (deck.lists.get(name, set()) for name in lists)
    return {key for keys in held if len(keys) > 1 for key in keys}


def labware_by_field(deck: Deck, facts: SourceFacts, name: str) -> dict[str, tuple[str, ...]]:
    """For keys of a map the one labware that is indexed by them: ``tubes[layout["mix"]]``.

    Or by a name that such a key gives its value: ``tube = row["tube"]``, a helper's parameter.
    """
    found: dict[str, set[str]] = {}
    for place in facts.places:
        names = origins(facts, place.names, (place.line,))
        if name in names:
            asked = {
                key
                for part in names
                for key, first, last in facts.asked.get(part, ())
                if first <= place.line <= last
            }
            for key in asked.union(place.keys):
                found.setdefault(key, set()).update(deck.by_name.get(place.labware, ()))
    return {key: tuple(labware) for key, labware in found.items() if len(labware) == 1}


def _alike(deck: Deck, keys: Sequence[str], spots: Sequence[str]) -> tuple[str, ...]:
    """Those in which all these wells are filled, if they are of one kind or each well goes into its
    namesake; or else all of them, if they are of one kind and the run fills the same wells of each.
    """
    filled = tuple(key for key in keys if all((key, spot) in deck.received for spot in spots))
    given = {frozenset(name for key, name in deck.received if key == one) for one in keys}
    meant = filled or (tuple(keys) if len(given) == 1 else ())
    return meant if deck.are_alike(meant) or _is_stamped(deck, meant, spots) else ()


def called_alike(deck: Deck, name: str, common: Common) -> str:
    """The one labware whose label shares a telling word with this constant's name."""
    dull = words_of(common.noise)
    words = set(tokens(name)) - dull
    alike = [info.key for info in deck.plates() if words & (set(tokens(info.label)) - dull)]
    return alike[0] if len(alike) == 1 else ""
