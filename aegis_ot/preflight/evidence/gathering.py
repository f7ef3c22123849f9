"""Gathers all that speaks for the roles of wells. ``spec/rules.md`` orders the strengths."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ...instrumentation import NameBinding
from ...vocabulary import WellRef
from ..layouts import Deck, well_names
from ..rules import Common
from ..text import SourceFacts
from ..trace import Trace
from .clues import Clue, Strength, shortened
from .described_labware import described_labware
from .fields import named_fields
from .grids import drawn_maps
from .helpers import helper_names
from .item_notes import item_notes
from .labels import labels
from .legend_clues import with_codes_explained
from .level_spans import level_spans
from .listed_columns import listed_columns
from .loop_levels import loop_levels
from .mirrored import mirrored
from .names import call_arguments, named_wells
from .numbered_maps import numbered_maps
from .parallel_lists import amounts_beside
from .places import indexing_names
from .plate_maps import plate_maps
from .prose_grids import maps_in_prose
from .remarks import written_wells
from .run_maps import spotted_names, tabled_wells
from .spoken import said_in_the_run
from .step_comments import step_comments
from .text_tables import read_tables, transfer_lists, written_tables
from .trough_legends import trough_legends
from .zero_levels import meant_by_zero


def gather(
    trace: Trace,
    names: Sequence[NameBinding],
    facts: SourceFacts,
    given: Mapping[str, Sequence[str]],
    common: Common,
) -> list[Clue]:
    """All clues of one protocol.

    Args:
        trace: A first reading of the run, to know labware, liquids and used wells.
        names: Names that held wells, from the rehearsal.
        facts: What the text says.
        given: Roles given outright: role to places (``"4:H12"``, ``"PCR plate:A1-A8"``).
        common: Words for amounts.
    """
    deck = Deck(trace, names, facts)
    described = list(described_labware(deck, facts, common))
    tables = read_tables(facts)
    clues = [
        *_given(deck, given, common),
        *_liquids(trace, facts),
        *named_wells(deck, names, facts, common),
        *named_fields(names, facts),
        *item_notes(deck, names, facts, common),
        *labels(deck, common),
        *described,
        *indexing_names(deck, facts, common),
        *plate_maps(deck, facts, common, transfer_lists(deck, facts, tables)),
        *amounts_beside(deck, names, facts, common),
        *drawn_maps(deck, facts, common),
        *trough_legends(deck, facts, common),
        *numbered_maps(deck, names, facts, common),
        *listed_columns(deck, facts, common),
        *spotted_names(deck, names, facts, common),
        *tabled_wells(deck, names, facts, common),
        *written_tables(deck, facts, common, tables),
        *written_wells(deck, facts, common, tables),
        *maps_in_prose(deck, facts, common),
        *level_spans(deck, facts, common),
        *step_comments(trace, facts, common),
        *said_in_the_run(trace, facts, common),
        *call_arguments(trace, facts, common),
        *helper_names(trace, facts, common),
        *loop_levels(trace, names, facts, common),
    ]
    clues = [*with_codes_explained(clues, facts), *meant_by_zero(clues, facts, common)]
    clues += mirrored(deck, clues, facts, common)
    return list(dict.fromkeys(clue for clue in clues if clue.wells))


def _given(deck: Deck, given: Mapping[str, Sequence[str]], common: Common) -> Iterator[Clue]:
    read = well_names(common)
    for role, places in given.items():
        wells: list[WellRef] = []
        for place in places:
            labware, _, spec = str(place).rpartition(":")
            for key in deck.labware_called(labware):
                wells.extend(
                    deck.ref(key, name) for name in read.wells(spec, deck.trace.labware[key])
                )
        yield Clue(
            Strength.GIVEN, role, tuple(wells), None, f"given to the guard as {role}", role=role
        )


def _liquids(trace: Trace, facts: SourceFacts) -> Iterator[Clue]:
    by_name: dict[str, list[WellRef]] = {}
    for well in trace.wells.values():
        for liquid in well.liquids:
            by_name.setdefault(liquid, []).append(well.ref)
    for liquid, wells in by_name.items():
        yield Clue(Strength.LIQUID, liquid, tuple(wells), None, f"liquid '{liquid}'")
        description = trace.descriptions.get(liquid) or facts.liquids.get(liquid)
        if description:
            yield Clue(
                Strength.DESCRIPTION,
                description,
                tuple(wells),
                None,
                f"liquid '{liquid}', described as '{shortened(description)}'",
                subject=False,
            )
