"""Rules as text for a terminal: one explained, or all in a list."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from ..preflight.rule_set import RuleSet
from ..preflight.rules import Example, Family, RuleSpec
from ..vocabulary import counted
from ..workbench.rule_example_files import examples_of

_WIDTH = 100


def rule_text(family: Family, rule: RuleSpec) -> str:
    """Everything about one rule."""
    return "\n".join(_rule(family, rule)) + "\n"


def _rule(family: Family, rule: RuleSpec) -> Iterator[str]:
    yield f"{rule.id} {rule.name} [{rule.severity}]"
    scope = "every protocol" if rule.scope == "all" else family.title
    yield f"Judged in: {scope} ({family.family})"
    yield ""
    yield _wrapped(rule.statement)
    yield ""
    yield _wrapped(rule.rationale, "Why: ")
    yield _wrapped(rule.fix, "Fix: ")
    yield _wrapped(rule.reference, "Reference: ")
    if rule.needs:
        yield _wrapped(f"{needs_in_words(family, rule)}; else the rule is undecided.", "Needs: ")
    if rule.unless_reported:
        yield _wrapped(
            f"Not reported for wells already reported under {', '.join(rule.unless_reported)}."
        )
    yield f"Waive: # aegis: ignore[{rule.id}] reason   (on the line, or at the top of the file)"
    for kind, example in shown_examples(family, rule):
        yield ""
        yield f"{kind}: {example.title}"
        yield textwrap.indent(code_of(example), "    ")


SHOWN_EXAMPLES = 2
"""Examples of a kind that a page shows; all of them stand in the rule's files."""


def shown_examples(family: Family, rule: RuleSpec) -> Iterator[tuple[str, Example]]:
    """Some examples of a rule, with what each does.

    Raises:
        RuleError: A file of examples cannot be used.
    """
    examples = examples_of(family)[rule.id]
    for kind, carried in (("Passes", examples.passing), ("Fails", examples.failing)):
        for example in carried[:SHOWN_EXAMPLES]:
            yield "Warns" if example.severity == "warning" else kind, example


def needs_in_words(family: Family, rule: RuleSpec) -> str:
    """The roles that must be known: ``no-template control; template or sample``."""
    return "; ".join(
        " or ".join(family.roles[role].title for role in need.split("|")) for need in rule.needs
    )


def code_of(example: Example) -> str:
    """An example's source."""
    return "\n".join(example.code)


def _wrapped(text: str, label: str = "") -> str:
    return textwrap.fill(label + text, _WIDTH, subsequent_indent=" " * min(len(label), 5))


def rule_list(rule_set: RuleSet) -> str:
    """All rules, by family, each with what it demands."""
    lines = []
    width = max(len(rule.id) for rule in rule_set.rules)
    names = max(len(rule.name) for rule in rule_set.rules)
    for family in rule_set.families:
        lines.append(f"{family.family}: {family.title}")
        for rule in family.rules:
            scope = ", every family" if rule.scope == "all" else ""
            lines.append(
                f"  {rule.id:{width}}  {rule.name:{names}}  {rule.severity}{scope}".rstrip()
            )
            lines.append(textwrap.indent(textwrap.fill(rule.statement, _WIDTH - 8), " " * 8))
    families = counted(len(rule_set.families), "family", "families")
    lines.append(f"{counted(len(rule_set.rules), 'rule')} in {families}.")
    return "\n".join(lines) + "\n"
