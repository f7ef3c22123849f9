"""Requests, answers and protocols for these tests."""

from __future__ import annotations

import functools
import textwrap
from typing import Any

from aegis_ot.adapters.opentrons.rehearsal import Script, record
from aegis_ot.llm import Request
from aegis_ot.llm.answer import strict_object
from aegis_ot.llm.backend import Message, Passage, PromptPicture
from aegis_ot.llm.backends.retrying import Clock
from aegis_ot.preflight import Options, Report, RuleSet, judge, load_rules
from aegis_ot.preflight.judging import Interpretation
from aegis_ot.preflight.opinion import make_dossier
from aegis_ot.vocabulary import Dossier

SCHEMA: dict[str, Any] = strict_object(
    verdict={"type": "string", "enum": ["pass", "fail"]},
    lines={"type": "array", "items": {"type": "integer"}},
)
GOOD = {"verdict": "fail", "lines": [3, 4]}
PNG = PromptPicture(b"\x89PNG not really", "image/png")


def request(text: str = "Is it right?", *pictures: PromptPicture) -> Request:
    return Request(
        "layer1",
        (Passage("Be exact.", cached=True), Passage("Be brief.")),
        (Message((text, *pictures)),),
        SCHEMA,
    )


class FakeClock(Clock):
    """Sleeps at once, and remembers it."""

    def __init__(self) -> None:
        self.slept: list[float] = []
        self._ahead = 0.0

    def now(self) -> float:
        return super().now() + self._ahead

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self._ahead += seconds

    def jitter(self) -> float:
        return 1.0


@functools.cache
def rule_set() -> RuleSet:
    return load_rules()


def check_with_dossier(
    script: Script, rules: RuleSet, options: Options | None = None
) -> tuple[Report, Dossier, Interpretation]:
    """Rehearse a protocol, judge it, and put its dossier together."""
    reading = Interpretation(record(script), rules, options)
    report = judge(reading)
    return report, make_dossier(reading, report), reading


@functools.cache
def examined(text: str, options: Options | None = None) -> tuple[Report, Dossier, Interpretation]:
    script = Script(textwrap.dedent(text), "protocol.py")
    return check_with_dossier(script, rule_set(), options)


def checked(text: str) -> tuple[Report, Dossier]:
    return examined(text)[:2]


def answer(**changes: Any) -> dict[str, Any]:
    """A whole answer to the hybrid question that says nothing."""
    empty: dict[str, Any] = {
        "family": "pcr", "roles": [], "answers": [], "findings": [], "summary": "",
    }  # fmt: skip
    return empty | changes


def proposal(
    role: str, wells: list[str], line: int, quote: str, levels: list[str] | None = None
) -> dict[str, Any]:
    said = [{"line": line, "quote": quote}]
    return {"role": role, "wells": wells, "levels": levels or [], "citations": said}


def reading_of(
    rule: str, said: str, wells: list[str], lines: list[int], reason: str = "So it is."
) -> dict[str, Any]:
    """An answer to an open question."""
    return {"rule": rule, "answer": said, "reason": reason, "wells": wells, "lines": lines}


def finding(
    rule: str, wells: list[str], lines: list[int], message: str = "It does."
) -> dict[str, Any]:
    return {
        "rule": rule, "message": message, "wells": wells, "lines": lines, "why": "", "fix": "",
    }  # fmt: skip


CONTAMINATED = """
metadata = {"apiLevel": "2.15", "protocolName": "PCR set-up"}

# NOTE_HERE
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4, "PCR plate")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, template, water = tubes["A1"], tubes["A2"], tubes["A3"]
    ntc = plate["H12"]
    reaction = plate["A1"]
    p20.transfer(15, master_mix, [reaction, ntc], new_tip="once")
    p20.pick_up_tip()
    p20.aspirate(5, template)
    p20.dispense(5, reaction)
    p20.mix(2, 10, reaction)
    p20.mix(2, 10, ntc)
    p20.drop_tip()
    p20.transfer(5, water, ntc)
"""
"""The template's tip mixes the NTC at line 18: PCR-2, decided by the checks."""

PROSE = """
metadata = {"apiLevel": "2.15", "protocolName": "PCR set-up"}

# Tubes of slot 2: the first one is the master mix, and the second one holds genomic DNA.
# On the plate A1 is the reaction. The last well is our no-template control.
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p20.transfer(15, tubes["A1"], [plate["A1"], plate["H12"]], new_tip="once")
    p20.pick_up_tip()
    p20.aspirate(5, tubes["A2"])
    p20.dispense(5, plate["A1"])
    p20.mix(2, 10, plate["A1"])
    p20.mix(2, 10, plate["H12"])
    p20.drop_tip()
"""
"""The same mistake where only sentences say what the wells are for."""

READ = [
    proposal("master_mix", ["2:A1"], 4, "the first one is the master mix"),
    proposal("template", ["2:A2"], 4, "the second one holds genomic DNA"),
    proposal("ntc", ["4:H12"], 5, "The last well is our no-template control."),
]
"""What a careful model proposes for it."""

SILENT = """
metadata = {"apiLevel": "2.15", "protocolName": "PCR set-up"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p20.transfer(15, tubes["A1"], [plate["A1"], plate["H12"]], new_tip="once")
    p20.pick_up_tip()
    p20.aspirate(5, tubes["A2"])
    p20.dispense(5, plate["A1"])
    p20.mix(2, 10, plate["A1"])
    p20.mix(2, 10, plate["H12"])
    p20.drop_tip()
"""
"""The same mistake where no name says what a well is for: the checks are undecided."""
