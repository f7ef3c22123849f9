"""What a rule file may say: an assay family, its roles, its rules.

A family says which words reveal it, which roles its wells play, and which rules hold. A rule
names checks (:mod:`aegis_ot.preflight.checks`) and their parameters; it holds no code.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, field
from functools import cached_property
from typing import Annotated, Any, ClassVar, Literal

from .dataclass_reader import NOT_EMPTY, Name, Word

SCHEMA_VERSION = 2
READABLE = (1, SCHEMA_VERSION)
"""Schema 1 without the fields that are gone (``DROPPED``) is schema 2."""

_NAME = "name such wells in the protocol, load a liquid, or give them in the guard's `roles`"
_BY_NAME = (
    "single_with single_beside used_like gets in_place_of common_to called_alike_beside passed_on "
    "feeds feeds_beside"
)


def role_names(required: bool = False) -> Any:
    """A field that lists roles of the family, ``"a|b"`` for either; what it names must exist."""
    default = MISSING if required else ()
    return field(default=default, metadata={"roles": True})


@dataclass(frozen=True)
class Signal:
    """Words that speak for a family.

    Attributes:
        words: Words and phrases, found in any spelling, in capitals or not, in the plural:
            "no template control" is in ``noTemplateControls``. ``#`` stands for any number.
        weight: How much it counts, once; negative words speak against the family.
        defining: Whether it can make the family known. Words that other assays use as well only
            add to what defines it.
        roles: Roles of the family whose words count as well.
    """

    words: tuple[Word, ...] = ()
    weight: float = 1.0
    defining: bool = True
    roles: tuple[str, ...] = role_names()
    DROPPED: ClassVar[Mapping[str, str]] = {"once": "leave it out: each signal counts once"}


Shape = Literal["chain", "pooling", "reactions"]


@dataclass(frozen=True)
class ShapeSignal:
    """A shape of the liquid's ways that speaks for a family, or against it.

    Attributes:
        shape: ``chain``, ``pooling`` or ``reactions``.
        weight: How much it counts for three wells; twice as much from six on.
        unless: Shapes beside which it says nothing.
        defining: Whether it can make the family known.
    """

    shape: Shape
    weight: float
    unless: tuple[Shape, ...] = ()
    defining: bool = False


@dataclass(frozen=True)
class RoleSignal:
    """Roles that make a family known together, where wells are named for all of them.

    Attributes:
        roles: Roles of the family; ``"a|b"`` for either.
    """

    roles: tuple[str, ...] = role_names(required=True)
    DROPPED: ClassVar[Mapping[str, str]] = {"weight": "leave it out: it makes the family known"}


@dataclass(frozen=True)
class RoleSpec:
    """What a well may be for, and which words say so. What is "derived" gives it to wells that
    no word names.

    Attributes:
        title: In words, for messages: "no-template control".
        parents: More general roles that it also counts as.
        side: ``source`` if the words mean this role only in wells that liquid is drawn from
            first, ``destination`` if only in wells that liquid is put into first, or ``any``.
        words: Words and phrases that name it, as in signals.
        never: Phrases that hold one of the words and still do not name it.
        differing: Those of its words that in the plural, or for a labware, stand for liquids which
            differ, and so do not name it: a rack of "stocks".
        alike: Those of its words that, loaded into several wells, may be one liquid: "antibody".
        one_liquid: Whether all wells of this role hold the same liquid unless named apart.
        implies_contents: Whether such a well held liquid before the run.
        filled_by: For ``implies_contents``: roles whose liquid, given in the run, would make up
            those contents.
        level: Value on the scale of concentrations or doses that this role has by itself: 0 for
            a blank.
        dosed: Whether its wells differ in dose. Such a well of dose 0 has another role, or none.
        may_be: Roles that a liquid of this one is used as, if that is said as well: "PBS
            (vehicle)".
        receives: Derived: a destination that is given liquid of one of these roles.
        loaded_with: Derived: a destination that was loaded with liquid which these roles' words
            name.
        follows: Derived: a well that is given what stands in a source of one of these roles: the
            control that the liquid is for.
        without: For ``follows``: what such a well must not hold. A liquid that goes to most of the
            wells that hold it is everybody's, and marks no control.
        one_to_one: Derived: unnamed wells of a plate or rack that each serve one well of their own.
        loaded: Derived: a well with a loaded liquid whose name says no role: ``shared`` where it
            serves several wells, ``single`` where it serves one or two, ``kept`` where the run
            only adds to it.
    """

    title: str
    parents: tuple[str, ...] = role_names()
    side: Literal["source", "destination", "any"] = "any"
    words: tuple[Word, ...] = ()
    never: tuple[Word, ...] = ()
    differing: tuple[Word, ...] = ()
    alike: tuple[Word, ...] = ()
    one_liquid: bool = False
    implies_contents: bool = False
    filled_by: tuple[str, ...] = role_names()
    level: float | None = None
    dosed: bool = False
    may_be: tuple[str, ...] = role_names()
    receives: tuple[str, ...] = role_names()
    loaded_with: tuple[str, ...] = role_names()
    follows: tuple[str, ...] = role_names()
    without: tuple[str, ...] = role_names()
    one_to_one: bool = False
    loaded: Literal["", "shared", "single", "kept"] = ""
    DROPPED: ClassVar[Mapping[str, str]] = {
        **dict.fromkeys(_BY_NAME.split(), _NAME),
        "holds": "load the liquid, and list its role in `receives`",
        "undosed": "give the wells of dose 0 a name of their own",
        "replicated": "name the wells of each plate",
        "receives_with": "leave it out: `receives` alone decides",
    }


@dataclass(frozen=True)
class SeriesSpec:
    """Which roles make a dilution series.

    Attributes:
        stock: What is diluted.
        diluent: What it is diluted with.
        diluent_else: What counts as diluent where nothing is called so: the one of these that
            the wells are mostly filled from.
    """

    stock: tuple[str, ...] = role_names(required=True)
    diluent: tuple[str, ...] = role_names(required=True)
    diluent_else: tuple[str, ...] = role_names()
    DROPPED: ClassVar[Mapping[str, str]] = {"wells": "leave it out"}


@dataclass(frozen=True)
class Example:
    """A snippet of a protocol and what it shows.

    Attributes:
        title: What it shows: "one tip for two samples".
        code: Its lines: the body of ``run`` on a small fixed deck, or a whole protocol.
        also: Further rules that a failing one breaks.
        severity: What the findings of a failing one are: ``error``, ``warning``, or ``any``.
    """

    title: str
    code: tuple[str, ...]
    also: tuple[str, ...] = ()
    severity: Literal["any", "error", "warning"] = "any"


@dataclass(frozen=True)
class Examples:
    """At least one of each, here or in the file of examples beside the rule file.

    Attributes:
        passing: Snippets in which no rule of the family finds anything.
        failing: Snippets in which the rule does.
    """

    passing: tuple[Example, ...] = ()
    failing: tuple[Example, ...] = ()


@dataclass(frozen=True)
class RuleSpec:
    """One rule.

    Attributes:
        id: ``"PCR-2"``; no other rule has it, in capitals or not.
        name: ``"fresh-tip-template-to-ntc"``.
        statement: What must hold.
        severity: ``error`` or ``warning``.
        scope: ``family`` or ``all``: whether it is judged in every family's protocols.
        needs: Roles that must be known to judge it; ``"a|b"`` for either.
        checks: Checks that decide it, with their parameters; all of them must hold.
        unless_reported: Rules, of any family, whose findings on the same wells replace this one's.
        indicators: What to look for in the source, for a model.
        prompt: Instruction for a model.
        rationale: Why it matters.
        reference: Where that is written.
        fix: How to mend a violation.
        examples: Passing and failing snippets; the shipped ones lie in files of their own.
    """

    id: Name
    name: str
    statement: str
    severity: Literal["error", "warning"]
    needs: tuple[str, ...] = field(metadata={"roles": True})
    checks: Annotated[tuple[Mapping[str, Any], ...], NOT_EMPTY]
    rationale: str
    reference: str
    fix: str
    examples: Examples = field(default_factory=Examples)
    scope: Literal["family", "all"] = "family"
    unless_reported: tuple[str, ...] = ()
    indicators: tuple[str, ...] = ()
    prompt: str = ""


@dataclass(frozen=True)
class Family:
    """One assay family, as its file describes it.

    Attributes:
        family: Its name, as ``--assay`` takes it: ``"pcr"``; no other family has it.
        title: In words: "PCR and qPCR set-up".
        description: What is done in such an assay.
        signals: Words that reveal it. A signal of weight 3 makes it known, of less weight two
            that agree.
        roles: What its wells may be for, by name.
        rules: What must hold; at least one.
        schema: The version of this format.
        series: Which roles make a dilution series, if the family has any: for the checks of
            series.
        shapes: Shapes of the liquid's ways that speak for the family, or against it.
        known_by: Roles that make it known together, where wells are named for all of them.
        default: Whether it is judged where nothing speaks for another family. One of all families
            is, and that is the shipped ``generic``.
        beside: Whether it is judged beside every other family that is known, and silences only the
            ``default`` one: a clean-up within a PCR workflow.
    """

    family: Name
    title: str
    description: str
    signals: tuple[Signal, ...]
    roles: Mapping[Name, RoleSpec]
    rules: Annotated[tuple[RuleSpec, ...], NOT_EMPTY]
    schema: int = SCHEMA_VERSION
    series: SeriesSpec = field(default_factory=lambda: SeriesSpec((), ()))
    shapes: tuple[ShapeSignal, ...] = ()
    known_by: tuple[RoleSignal, ...] = ()
    default: bool = False
    beside: bool = False
    path: str = field(default="", compare=False, metadata={"internal": True})

    @property
    def is_assay(self) -> bool:
        """Whether a protocol may be of it: it has roles, and not only rules that hold for all."""
        return bool(self.roles)

    def closure(self, role: str) -> frozenset[str]:
        """A role and all roles above it."""
        return self._closures[role]

    @cached_property
    def _closures(self) -> Mapping[str, frozenset[str]]:
        def closed(role: str) -> frozenset[str]:
            return frozenset({role}).union(*map(closed, self.roles[role].parents))

        return {role: closed(role) for role in self.roles}

    def are_kin(self, one: str, other: str) -> bool:
        """Whether one of two roles counts as the other."""
        if one not in self.roles or other not in self.roles:
            return one == other
        return one in self.closure(other) or other in self.closure(one)


@dataclass(frozen=True)
class Common:
    """``common.json``: word lists that belong to no family.

    Attributes:
        pauses: What a pause's message says may have been done, see ``trace.pauses``.
        prefilled: Names of wells that held liquid before the run.
        waste: Names of wells that are waste.
        flow_through: Names of labware that liquid runs through: it holds nothing.
        levels: Words for concentrations, with their value: ``blank`` is 0.
        amounts: Words for concentrations or doses: ``conc``.
        aliases: Abbreviations and what they stand for, word by word.
        joints: What follows one of these only says more: "drug in medium".
        sides: Words that only say on which side of a transfer something stands: ``src``.
        joining: Words that join several things: "and".
        lacking: Words before something that is not there: "without".
        noise: Words that tell no compound from another: "stock", "well".
        distinct: Words for things of which each has a name of its own: "compounds".
        dose_words: Words for amounts of one thing: "dose".
        schema: The version of this format.
    """

    pauses: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    prefilled: tuple[str, ...] = ()
    waste: tuple[str, ...] = ()
    flow_through: tuple[str, ...] = ()
    levels: Mapping[str, float] = field(default_factory=dict)
    amounts: tuple[str, ...] = ()
    aliases: Mapping[str, str] = field(default_factory=dict)
    joints: tuple[str, ...] = ()
    sides: tuple[str, ...] = ()
    joining: tuple[str, ...] = ()
    lacking: tuple[str, ...] = ()
    noise: tuple[str, ...] = ()
    distinct: tuple[str, ...] = ()
    dose_words: tuple[str, ...] = ()
    schema: int = SCHEMA_VERSION
