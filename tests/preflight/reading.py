"""Small protocols, read: what their names and data say."""

from __future__ import annotations

import functools
import textwrap

from aegis_ot.preflight import Options, Script, load_rules, record
from aegis_ot.preflight.evidence import Evidence, Kind
from aegis_ot.preflight.judging import Interpretation
from aegis_ot.preflight.roles import Roles

DECK = """
metadata = {{"apiLevel": "2.15"}}
{head}

def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1, {label})
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
{body}
"""


@functools.cache
def read(body: str, head: str = "", label: str = "None", assay: str = "pcr") -> Interpretation:
    """A protocol on a PCR plate in slot 1 and a tube rack in slot 2."""
    inside = textwrap.indent(textwrap.dedent(body).strip("\n"), "    ")
    text = DECK.format(head=textwrap.dedent(head), body=inside, label=label)
    return Interpretation(
        record(Script(text, "protocol.py")), load_rules(), Options(assay=(assay,))
    )


def evidence(reading: Interpretation, kind: Kind) -> dict[str, tuple[Evidence, list[str]]]:
    """Evidence of one kind by its words, with the addresses of its wells."""
    return {
        one.text: (one, [ref.address for ref in one.wells])
        for one in reading.evidence
        if one.kind is kind and not one.whole
    }


def roles_by_well(reading: Interpretation) -> dict[str, str]:
    """The role that evidence gives each well, by its address."""
    (roles,) = (one for one in reading.roles if isinstance(one, Roles))
    return {ref.address: assigned.role for ref, assigned in roles.by_well.items()}
