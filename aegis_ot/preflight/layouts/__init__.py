"""How people write where things stand: wells, labware, lists, tables, drawings and sentences.

What is written otherwise is put into plain lines (:func:`plain_lines`, :func:`told_tables`), these
are cut into parts that each name wells of their own (:func:`parts_of`), and :class:`Topic` knows
which labware a part means. Nothing here knows a role or an assay.
"""

from .clauses import Part, axis_of, numbers_things, parts_of, with_what_follows
from .deck import LEFT_OUT, MOST_TUBES, Deck
from .drawn_grids import Drawing, drawn_grid
from .in_turn import items_after
from .labware_nouns import IN_BRACKETS, LabwareNouns
from .map_labware import called_alike, labware_by_field, labware_of_map, refs_of, used_with
from .plain_lines import plain_lines
from .prose import in_sentences
from .shared_words import Amount, unit_in_brackets, with_shared_words, with_unit
from .side_by_side import side_by_side
from .told_tables import told_tables
from .topics import Topic
from .well_names import WellNames, plain_name, well_names, wells_between
from .work_lists import drawn_and_filled, is_work_list, labware_by_key, labware_in
from .written_columns import WrittenColumns

__all__ = [
    "IN_BRACKETS",
    "LEFT_OUT",
    "MOST_TUBES",
    "Amount",
    "Deck",
    "Drawing",
    "LabwareNouns",
    "Part",
    "Topic",
    "WellNames",
    "WrittenColumns",
    "axis_of",
    "called_alike",
    "drawn_and_filled",
    "drawn_grid",
    "in_sentences",
    "is_work_list",
    "items_after",
    "labware_by_field",
    "labware_by_key",
    "labware_in",
    "labware_of_map",
    "numbers_things",
    "parts_of",
    "plain_lines",
    "plain_name",
    "refs_of",
    "side_by_side",
    "told_tables",
    "unit_in_brackets",
    "used_with",
    "well_names",
    "wells_between",
    "with_shared_words",
    "with_unit",
    "with_what_follows",
]
