"""Run a protocol's text in the real simulator with listeners attached."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass, field

from aegis_ot.adapters.opentrons.instrumentation import Event, Operation, OperationKind
from aegis_ot.adapters.opentrons.rehearsal import Recording, Script, record

FILE_NAME = "protocol.py"


@dataclass
class Heard:
    """A listener that keeps what it hears."""

    operations: list[Operation] = field(default_factory=list)
    announced: list[Operation] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)

    def before(self, operation: Operation) -> None:
        self.announced.append(operation)

    def after(self, operation: Operation) -> None:
        self.operations.append(operation)

    def event(self, event: Event) -> None:
        self.events.append(event)

    def of(self, *kinds: OperationKind) -> list[Operation]:
        return [operation for operation in self.operations if operation.kind in kinds]


def run(text: str, **options: object) -> tuple[Heard, Recording]:
    """Rehearse ``text`` (dedented) and return what was heard."""
    heard = Heard()
    script = Script(textwrap.dedent(text), FILE_NAME, **options)  # type: ignore[arg-type]
    return heard, record(script, [heard], timeout_s=60)


def ot2(body: str, api_level: str = "2.20") -> str:
    """A protocol with a plate, a reservoir, tips and two p300s around ``body``."""
    setup = f"""
    metadata = {{"apiLevel": "{api_level}"}}
    def run(protocol):
        plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "my plate")
        reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2)
        tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
        single = protocol.load_instrument("p300_single_gen2", "left", [tips])
        multi = protocol.load_instrument("p300_multi_gen2", "right", [tips])
    """
    return textwrap.dedent(setup) + textwrap.indent(textwrap.dedent(body), "    ")


def flex(body: str, api_level: str = "2.22") -> str:
    """The same on a Flex, with a trash bin."""
    setup = f"""
    requirements = {{"robotType": "Flex", "apiLevel": "{api_level}"}}
    def run(protocol):
        plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "D1", "my plate")
        reservoir = protocol.load_labware("nest_12_reservoir_15ml", "D2")
        tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "C3")
        trash = protocol.load_trash_bin("A3")
        single = protocol.load_instrument("flex_1channel_1000", "left", [tips])
        multi = protocol.load_instrument("flex_8channel_1000", "right", [tips])
    """
    return textwrap.dedent(setup) + textwrap.indent(textwrap.dedent(body), "    ")
