"""The documentation pages of the rules, in Markdown, from the rule files and the checks."""

from __future__ import annotations

import dataclasses
import inspect
import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from ..errors import RuleError
from ..preflight.checks import CHECKS
from ..preflight.rule_set import RuleSet
from ..preflight.rules import Example, Family, RoleSpec, RuleSpec
from .field_page import field_page, parameters
from .rule_text import code_of, needs_in_words, shown_examples

_HEAD = "<!-- Written by `aegis-ot rules docs` from the rule files. Edit those. -->"
_CODE_HEAD = (
    "<!-- Written by `aegis-ot rules docs` from the docstrings in aegis_ot/preflight. "
    "Edit those. -->"
)
_OPTIONAL = {"required": "", "none": " (optional)"}


def rule_pages(rule_set: RuleSet) -> dict[str, str]:
    """All pages, by file name: an index, one page per family, those of checks and of fields.

    Raises:
        RuleError: A family has the name of one of the other pages.
    """
    pages = {
        "README.md": "\n".join(_index(rule_set)) + "\n",
        "checks.md": "\n".join(_checks(rule_set)) + "\n",
        "fields.md": field_page(_CODE_HEAD),
    }
    taken = {name.casefold() for name in pages}
    for family in rule_set.families:
        name = f"{family.family}.md"
        if name.casefold() in taken:
            raise RuleError(
                f"{family.path}: family: the page {name} is not about a family; "
                f"give {family.family} another name"
            )
        pages[name] = "\n".join(_family(family)) + "\n"
    return pages


def _index(rule_set: RuleSet) -> Iterator[str]:
    yield _HEAD
    yield ""
    yield "# Rules"
    yield ""
    yield (
        f"{len(rule_set.rules)} rules: of {len(rule_set.assays)} assay families, and of handling, "
        "which concerns every protocol. A rule is data: a JSON file per family in `rules/` names "
        "the words that reveal the family, the roles that its wells play, and its rules; each "
        "rule names [checks](checks.md) and their parameters. All that such a file may hold: "
        "[fields](fields.md). `aegis-ot explain RULE` shows a rule in the terminal."
    )
    yield ""
    yield "| rule | name | severity | statement |"
    yield "|---|---|---|---|"
    for family in rule_set.families:
        for rule in family.rules:
            yield (
                f"| [{rule.id}]({family.family}.md#{_anchor(rule)}) | {rule.name} | "
                f"{rule.severity} | {_cell(rule.statement)} |"
            )
    yield ""
    yield "## Families"
    yield ""
    for family in rule_set.families:
        yield f"- [{family.title}]({family.family}.md) (`{family.family}`): {family.description}"
    yield ""
    yield "## Waiving a rule"
    yield ""
    yield "On the line concerned, on a line of its own above it, or at the top of the file:"
    yield ""
    yield "```python"
    yield "# aegis: ignore[SD-5] one tip per series is accepted in this teaching protocol"
    yield "```"
    yield ""
    yield "A reason is required, and a waiver that covers nothing is reported. For a project:"
    yield ""
    yield "```toml"
    yield "[tool.aegis-ot]"
    yield 'ignore = ["GEN-3"]'
    yield ""
    yield "[tool.aegis-ot.severity]"
    yield 'PCR-6 = "error"'
    yield ""
    yield "[[tool.aegis-ot.waivers]]"
    yield 'rules = ["SD-5"]'
    yield 'files = ["tutorials/*.py"]'
    yield 'reason = "One tip per series is how we teach it."'
    yield "```"


def _family(family: Family) -> Iterator[str]:
    yield _HEAD
    yield ""
    yield f"# {family.title}"
    yield ""
    yield f"{family.description} Family `{family.family}`."
    for rule in family.rules:
        yield ""
        yield from _rule(family, rule)
    yield ""
    yield "## Roles"
    yield ""
    yield "| role | meaning | also counts as | words that name it |"
    yield "|---|---|---|---|"
    for name, role in family.roles.items():
        yield f"| `{name}` | {role.title} | {', '.join(role.parents)} | {_words(role)} |"


def _words(role: RoleSpec) -> str:
    shown = ", ".join(role.words[:12])
    more = f" and {len(role.words) - 12} more" if len(role.words) > 12 else ""
    if not role.words and role.receives:
        return f"follows from receiving {', '.join(role.receives)}"
    return _cell(shown + more)


def _rule(family: Family, rule: RuleSpec) -> Iterator[str]:
    yield f"## {rule.id} {rule.name}"
    yield ""
    yield f"**{rule.severity}**. {rule.statement}"
    yield ""
    yield f"**Why.** {rule.rationale}"
    yield ""
    yield f"**Fix.** {rule.fix}"
    yield ""
    yield f"**Reference.** {rule.reference}"
    yield ""
    if rule.scope == "all":
        yield "Judged in protocols of every family."
        yield ""
    if rule.needs:
        yield f"Needs to know: {needs_in_words(family, rule)}. Otherwise it is undecided."
        yield ""
    if rule.unless_reported:
        yield (
            "Not reported for wells that are already reported under "
            f"{', '.join(rule.unless_reported)}."
        )
        yield ""
    yield "Decided by:"
    yield ""
    for check in rule.checks:
        yield f"- {_check(check)}"
    for kind, example in shown_examples(family, rule):
        yield ""
        yield from _example(kind, example)


def _check(check: Mapping[str, Any]) -> str:
    name = check["check"]
    parameters = [
        f"{key} = {json.dumps(value, ensure_ascii=False)}"
        for key, value in check.items()
        if key != "check"
    ]
    told = f": `{'; '.join(parameters)}`" if parameters else ""
    return f"[`{name}`](checks.md#{name}){told}"


def _example(kind: str, example: Example) -> Iterator[str]:
    yield f"{kind}: {example.title}"
    yield ""
    yield "```python"
    yield code_of(example)
    yield "```"


def _checks(rule_set: RuleSet) -> Iterator[str]:
    yield _CODE_HEAD
    yield ""
    yield "# Checks"
    yield ""
    yield (
        "The vocabulary that rules are made of. Lists of roles are names of the family's roles; "
        "parameters may be left out where it says so."
    )
    for name, check in CHECKS.items():
        users = [r.id for r in rule_set.rules if any(c["check"] == name for c in r.checks)]
        yield ""
        yield f"## {name}"
        yield ""
        text, _, _ = _documentation(check).partition("\n\nAttributes:\n")
        yield text
        yield ""
        for parameter, (default, meaning) in parameters(check).items():
            yield f"- `{parameter}`{_OPTIONAL.get(default, f' ({default} if left out)')}: {meaning}"
        if dataclasses.fields(check):
            yield ""
        yield f"Used by: {', '.join(users) or 'no shipped rule'}."


def _documentation(check: type) -> str:
    return (inspect.getdoc(check) or "").replace("``", "`")


def _anchor(rule: RuleSpec) -> str:
    """As GitHub makes it of a heading."""
    return re.sub(r"[^\w\- ]", "", f"{rule.id} {rule.name}").lower().replace(" ", "-")


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")
