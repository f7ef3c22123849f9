"""What follows from the liquid's ways for roles, and from roles for the contents of wells."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from ...vocabulary import WellRef
from ..evidence import Kind
from ..rules import RoleSpec
from ..trace import Trace, Well, chains_of
from .roles import Roles

_FEWEST_PAIRS = 3
_SMALLEST_PLATE = 24
_SHARED = 3
"""A liquid that serves as many wells is a reagent for all rather than something of its own."""

_FEWEST_FILLED = 3
_SHARE = 0.3
"""Two series may have a diluent each; a buffer that fills one well of many is rather a mistake."""


def derive(roles: Roles, trace: Trace) -> None:
    """Give wells the roles that follow from what they give and receive.

    A reaction is what template goes into; wells that only pass liquid on (a dilution plate) are
    none.
    """
    _settle_diluent(roles, trace)
    _unsay_ends(roles, trace)
    for name, spec in roles.family.roles.items():
        if spec.one_to_one:
            _derive_one_to_one(roles, name, trace)
        if spec.loaded:
            _derive_loaded(roles, name, spec.loaded, trace)
    for name, spec in roles.family.roles.items():
        if spec.receives:
            _derive_receiving(roles, name, spec, trace)
        if spec.loaded_with:
            _derive_loaded_with(roles, name, spec, trace)
    for name, spec in roles.family.roles.items():
        if spec.follows:
            _derive_following(roles, name, spec, trace)


def _unsay_ends(roles: Roles, trace: Trace) -> None:
    """Forget a stock's name where a list is called for what goes into its wells, and so no less for
    the one that is left out: ``mastermix_wells``.
    """
    ends: dict[str, list[Well]] = {}
    for well in trace.wells.values():
        assigned = roles.by_well.get(well.ref)
        if assigned is None or not trace.usage[well.ref].ends:
            continue
        if assigned.kind <= Kind.NAME and roles.family.roles[assigned.role].one_liquid:
            ends.setdefault(assigned.text, []).append(well)
    for wells in ends.values():
        role = roles.by_well[wells[0].ref].role
        if 2 * sum(_receives(roles, well, (role,), ()) for well in wells) > len(wells):
            for well in wells:
                roles.by_well.pop(well.ref, None)


def _derive_one_to_one(roles: Roles, name: str, trace: Trace) -> None:
    """Wells of a plate that each serve one well of their own hold each something of its own.

    A liquid that stands in several wells (a strip of master mix) serves several wells each.
    """
    served = {ref: into for ref, into in trace.served.items() if trace.usage[ref].prefilled}
    for key, info in trace.labware.items():
        refs = [ref for ref in served if ref.labware == key]
        if info.centers_channels or len(info.wells) < _SMALLEST_PLATE or len(refs) < _FEWEST_PAIRS:
            continue
        into = {well for ref in refs for well in served[ref]}
        if all(len(served[ref]) == 1 and not roles.of(ref) for ref in refs) and (
            len(into) == len(refs)
        ):
            roles.apart.update(refs)
            for ref in refs:
                roles.derive(ref, name)


def _derive_loaded(roles: Roles, name: str, kind: str, trace: Trace) -> None:
    """A loaded liquid has a use even if its name is none of the known words."""
    served = trace.served
    topped_up = {well for wells in served.values() for well in wells}
    # In the order of the trace: a set's own order differs from process to process.
    for ref in [well.ref for well in trace.wells.values() if well.ref in roles.unnamed]:
        if not roles.of(ref) <= roles.family.closure(name):
            continue  # something else, or more than "destination", is said of it
        if ref not in served:
            use = "kept" if ref in topped_up else ""
        elif any(len(served.get(well, ())) >= _SHARED for well in served[ref]):
            use = ""  # part of a mix that is made in the run
        else:
            use = "shared" if len(served[ref]) >= _SHARED else "single"
        if use == kind:
            roles.derive(ref, name)


def _derive_receiving(roles: Roles, name: str, spec: RoleSpec, trace: Trace) -> None:
    """Wells that receive a liquid of ``spec.receives`` and pass nothing on."""
    for well in trace.wells.values():
        if not trace.usage[well.ref].ends:
            continue
        assigned = roles.by_well.get(well.ref)
        unlike = assigned is not None and assigned.role not in roles.family.closure(name)
        if assigned is not None and unlike:
            named_for = roles.family.roles[assigned.role].receives
            if not assigned.whole or not named_for or _receives(roles, well, named_for, ()):
                continue
        if _receives(roles, well, spec.receives, (name,)):
            if unlike:
                del roles.by_well[well.ref]  # calibrators stand on the "CSF plate" as well
            roles.derive(well.ref, name)


def _receives(roles: Roles, well: Well, wanted: Collection[str], made: Collection[str]) -> bool:
    """Whether a liquid of these roles comes into a well, and not from one that it made already: a
    product that goes on to a gel makes no reaction there.
    """
    return any(
        roles.has(origin.ref, wanted)
        for one in well.received
        if not roles.has(one.source.ref, made)
        for origin in one.liquid
    )


def _derive_loaded_with(roles: Roles, name: str, spec: RoleSpec, trace: Trace) -> None:
    """Wells that stand where others are filled, and were loaded with a liquid of these roles."""
    closure = roles.family.closure
    for well in trace.wells.values():
        said = roles.also.get(well.ref, {}) if well.liquids else {}
        loaded = (role for role, kind in said.items() if kind in (Kind.LIQUID, Kind.DESCRIPTION))
        named = frozenset[str]().union(*map(closure, loaded))
        if named.isdisjoint(spec.loaded_with) or trace.usage[well.ref].first_drawn:
            continue
        assigned = roles.by_well.get(well.ref)
        if assigned is None or not roles.is_control(assigned.role):
            roles.derive(well.ref, name)


def _derive_following(roles: Roles, name: str, spec: RoleSpec, trace: Trace) -> None:
    """A well that is given what stands in a control's tube is that control.

    A tube that serves most of the wells that hold what the control must not hold is everybody's,
    as is one that only its liquid's name speaks for and that mostly serves such wells.
    """
    barred = {w.ref for w in trace.wells.values() if _receives(roles, w, spec.without, ())}
    called = (ref for ref in roles.by_well if roles.is_called(ref, (name,)))
    roles.tubes.update(ref for ref in called if trace.sides(ref)[0] == "source")
    for source, served in trace.served.items():
        told = source in roles.marked and name in roles.also.get(source, {})
        marked = told or roles.has(source, (name,))
        if not trace.usage[source].first_drawn or not (marked or roles.has(source, spec.follows)):
            continue
        if roles.has(source, spec.without):
            continue
        roles.tubes.add(source)
        spoiled = len(served & barred)
        if spoiled > 1 and 2 * spoiled > len(barred):
            _say_what_it_is(roles, source, name)
        elif marked or 2 * spoiled <= len(served):
            new = _follow(roles, name, served, trace)
            roles.followed |= new
            roles.supposed |= new if not marked else set()


def _say_what_it_is(roles: Roles, source: WellRef, control: str) -> None:
    """Of water that is called for the control, and that all wells are given: it is water."""
    specs = roles.family.roles
    liquids = [role for role in roles.also.get(source, {}) if control in specs[role].may_be]
    if liquids and roles.by_well[source].role == control:
        roles.by_well[source].role = min(liquids)


def _follow(roles: Roles, name: str, into: Iterable[WellRef], trace: Trace) -> set[WellRef]:
    """Give wells a control's role, and those that are filled from them alone: no pool.

    Returns those that nothing else says it of.
    """
    found: set[WellRef] = set()
    kin, open_ = roles.family.are_kin, list(into)
    made_from: dict[WellRef, set[WellRef]] = {}
    for one in trace.transfers:
        if trace.usage[one.source.ref].received:
            made_from.setdefault(one.well.ref, set()).add(one.source.ref)
    while open_:
        ref = open_.pop()
        assigned, used = roles.by_well.get(ref), trace.usage[ref]
        unlike = assigned and not (assigned.whole or kin(assigned.role, name))
        if unlike or used.first_drawn or used.drain or name in roles.derived.get(ref, ()):
            continue
        if any(name not in roles.of(one) for one in made_from.get(ref, ())):
            continue
        if not roles.has(ref, (name,)):
            found.add(ref)
        roles.derive(ref, name)
        open_ += trace.served.get(ref, ())
    return found


def implied_contents(roles: Roles, trace: Trace) -> set[WellRef]:
    """Wells whose role says that they held liquid before the run.

    Not those that are given in the run what such a well is made of, or something unknown.
    """
    specs = roles.family.roles
    found = {
        ref: specs[assigned.role].filled_by
        for ref, assigned in roles.by_well.items()
        if specs[assigned.role].implies_contents
    }
    for one in trace.transfers if found else ():
        if one.well.ref in found:
            theirs = roles.of(one.source.ref)
            if not theirs or not theirs.isdisjoint(found[one.well.ref]):
                del found[one.well.ref]
    return set(found)


def _settle_diluent(roles: Roles, trace: Trace) -> None:
    """Where nothing is called the diluent, find it among the buffers, or by its use."""
    spec = roles.family.series
    if not spec.diluent or any(roles.known(role) for role in spec.diluent):
        return
    filled: dict[str, set[WellRef]] = {}
    sources: dict[str, set[WellRef]] = {}
    for source, wells in trace.served.items():
        assigned = roles.by_well.get(source)
        if assigned is not None and roles.has(source, spec.diluent_else):
            text = _without_number(assigned.text)
            filled.setdefault(text, set()).update(wells)
            sources.setdefault(text, set()).add(source)
    if not filled:  # named, and never used: then something else is used in its place
        for ref, assigned in roles.by_well.items():
            if assigned.role in spec.diluent_else:
                sources.setdefault(_without_number(assigned.text), set()).add(ref)
        filled = {text: set() for text in sources} if len(sources) == 1 else {}
    if not filled:
        _settle_by_use(roles, trace, spec.diluent[0])
        return
    roles.diluent_guessed = len(filled) > 1
    total = len(set().union(*filled.values()))
    for text, wells in filled.items():
        if len(wells) >= _SHARE * total:
            for ref in sources[text]:
                roles.by_well[ref].role = spec.diluent[0]


def _without_number(text: str) -> str:
    """A name without the number that tells it from others of its kind."""
    return text.rstrip("0123456789_ ") or text


def _settle_by_use(roles: Roles, trace: Trace, diluent: str) -> None:
    """Where no name says so, the diluent is the one source that most of a chain is filled from.

    It goes into the wells before they are linked, all but the first and perhaps a few others.
    """
    links = [link for group in chains_of(trace.links) for link in group]
    targets, sources = {link.well for link in links}, {link.source for link in links}
    filled: dict[WellRef, set[WellRef]] = {}
    for one in trace.transfers:
        beside = one.source not in sources | targets
        if one.well in targets and beside and one.visit.empty_before:
            filled.setdefault(one.source.ref, set()).add(one.well.ref)
    best = [ref for ref, wells in filled.items() if 2 * len(wells) > len(targets)]
    if len(best) == 1 and len(filled[best[0]]) >= _FEWEST_FILLED and not roles.of(best[0]):
        roles.derive(best[0], diluent)
