"""What a rule file may say: an assay family, its roles, its rules.

A family says which words reveal it, which roles its wells play, and which rules hold. A rule
names checks (:mod:`aegis_ot.preflight.checks`) and their parameters; it holds no code.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal

from .common import SCHEMA_VERSION
from .limits import Name, NotEmpty, Word


def role_names() -> Any:
    """A field that lists roles of the family; left out, none. What it names must exist."""
    return field(default=(), metadata={"roles": True})


@dataclass(frozen=True)
class Signal:
    """Words that speak for a family.

    Attributes:
        words: Words and phrases, found in any spelling, in capitals or not, in the plural:
            "no template control" is in ``noTemplateControls``. ``#`` stands for any number.
        weight: How much a mention counts; negative words speak against the family.
        once: Whether the signal counts once, however often it is mentioned.
        defining: Whether it can make the family known. Words that other assays use as well only
            add to what defines it.
        roles: Roles of the family whose words count as well.
    """

    words: tuple[Word, ...] = ()
    weight: float = 1.0
    once: bool = True
    defining: bool = True
    roles: tuple[str, ...] = role_names()


Shape = Literal["chain", "chains_alone", "pooling", "reactions", "copying", "culture"]


@dataclass(frozen=True)
class ShapeSignal:
    """A shape of the liquid's ways that speaks for a family, or against it.

    Attributes:
        shape: ``chain``, ``chains_alone``, ``pooling``, ``reactions``, ``copying`` or ``culture``.
        weight: How much it counts for three wells; twice as much from six on. A chain counts
            twice where its wells were filled from one place before, and a culture plate once.
        unless: Shapes beside which it says nothing.
        defining: Whether it can make the family known.
        unless_named: Roles of the family: it says nothing where a well is named for one of them.
    """

    shape: Shape
    weight: float
    unless: tuple[Shape, ...] = ()
    defining: bool = False
    unless_named: tuple[str, ...] = role_names()


@dataclass(frozen=True)
class RoleSignal:
    """Roles that make a family known together, where wells are named for all of them.

    Attributes:
        roles: Roles of the family; ``"a|b"`` for either.
        weight: The score that the family has at least then: what its words have added counts.
    """

    roles: tuple[str, ...]
    weight: float = 4.0


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
        implies_contents: Whether such a well held liquid before the run.
        filled_by: For ``implies_contents``: roles whose liquid, given in the run, would make up
            those contents.
        feeds: Derived: an unnamed source that mostly feeds wells of these roles.
        feeds_beside: For ``feeds``: only if these wells all get a liquid of these roles as well.
        single_with: Derived: unnamed sources that each go into wells of their own which all get a
            liquid of these roles as well; three at least, or beside named ones of this role.
        single_beside: For ``single_with``: only in labware of which nothing is said, and where
            another one holds one of these roles.
        replicated: Whether plates that are filled alike and called alike have it in the same wells.
        one_liquid: Whether all wells of this role hold the same liquid unless named apart.
        one_to_one: Derived: unnamed wells of a plate or rack that each serve one well of their own;
            or some wells, where each has a name that no other one has.
        loaded: Derived: a well with a loaded liquid whose name says no role: ``shared`` where it
            serves several wells, ``single`` where it serves one or two, ``kept`` where the run
            only adds to it.
        may_be: Roles that a liquid of this one is used as, if that is said as well: "PBS
            (vehicle)"; or if it goes where they go, and none is named for them.
        level: Value on the scale of concentrations or doses that this role has by itself: 0 for
            a blank.
        receives: Derived: a destination that is given liquid of one of these roles.
        receives_with: For ``receives``: where wells get a liquid of these roles as well, straight
            from where it stands, it is they that are meant, and not what they are given on to.
        holds: Derived, where no well is a source of these roles: wells with one of its ``parents``
            and no other role whose loaded liquid is called so.
        dosed: Derived: a well on its side of which a concentration is said and no role, beside
            others; a source that goes into wells of one level only, in ``feeds``, has that level.
        undosed: Derived: what a well of this role, or of one above it, is whose level is 0, where
            others have doses: a control. Not where what it ``receives`` goes into such wells
            and into those of several doses.
        called_alike_beside: Derived: a source without a role that is called by the same word as
            the wells it goes into, on a plate with wells of these roles: "APAP" beside controls.
        used_like: Derived: unnamed sources that each go into wells of their own on the labware, and
            in the volume, where a source of one of these roles goes into others.
        gets: Derived, with ``in_place_of``: where no well is named for this role, those that get a
            liquid of these roles in the volume in which more wells get one of those.
        in_place_of: See ``gets``.
        common_to: Derived, where no well is named for this role: unnamed sources of which nearly
            all wells of these roles get one, in the same volume.
        passed_on: Derived: a well into which one of this role goes, unless that tops up many
            wells which have each a liquid of their own besides.
    """

    title: str
    parents: tuple[str, ...] = role_names()
    side: Literal["source", "destination", "any"] = "any"
    words: tuple[Word, ...] = ()
    never: tuple[Word, ...] = ()
    differing: tuple[Word, ...] = ()
    implies_contents: bool = False
    filled_by: tuple[str, ...] = role_names()
    feeds: tuple[str, ...] = role_names()
    feeds_beside: tuple[str, ...] = role_names()
    one_to_one: bool = False
    single_with: tuple[str, ...] = role_names()
    single_beside: tuple[str, ...] = role_names()
    replicated: bool = False
    loaded: Literal["", "shared", "single", "kept"] = ""
    one_liquid: bool = False
    may_be: tuple[str, ...] = role_names()
    level: float | None = None
    receives: tuple[str, ...] = role_names()
    receives_with: tuple[str, ...] = role_names()
    holds: tuple[str, ...] = role_names()
    dosed: bool = False
    undosed: tuple[str, ...] = role_names()
    called_alike_beside: tuple[str, ...] = role_names()
    used_like: tuple[str, ...] = role_names()
    gets: tuple[str, ...] = role_names()
    in_place_of: tuple[str, ...] = role_names()
    common_to: tuple[str, ...] = role_names()
    passed_on: bool = False


@dataclass(frozen=True)
class SeriesSpec:
    """Which roles make a dilution series.

    Attributes:
        wells: Wells of the series.
        stock: What is diluted.
        diluent: What it is diluted with.
        diluent_else: What counts as diluent where nothing is called so: the one of these that
            the wells are mostly filled from.
    """

    wells: tuple[str, ...] = field(metadata={"roles": True})
    stock: tuple[str, ...] = field(metadata={"roles": True})
    diluent: tuple[str, ...] = field(metadata={"roles": True})
    diluent_else: tuple[str, ...] = role_names()


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
    needs: tuple[str, ...]
    checks: Annotated[tuple[Mapping[str, Any], ...], NotEmpty()]
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
    """

    family: Name
    title: str
    description: str
    signals: tuple[Signal, ...]
    roles: Mapping[Name, RoleSpec]
    rules: Annotated[tuple[RuleSpec, ...], NotEmpty()]
    schema: int = SCHEMA_VERSION
    series: SeriesSpec | None = None
    shapes: tuple[ShapeSignal, ...] = ()
    known_by: tuple[RoleSignal, ...] = ()
    default: bool = False
    path: str = field(default="", compare=False, metadata={"internal": True})
