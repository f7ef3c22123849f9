"""The documentation pages of the rules, in Markdown, from the rule files and the checks."""

from __future__ import annotations

import dataclasses
import inspect
import json
import re
from collections.abc import Mapping
from typing import Any

from ..errors import RuleError
from ..preflight.checks import CHECKS
from ..preflight.rule_set import RuleSet
from ..preflight.rules import Family, RoleSpec, RuleSpec
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
        "README.md": _index(rule_set),
        "checks.md": _checks(rule_set),
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
        pages[name] = _family(family)
    return pages


def _index(rule_set: RuleSet) -> str:
    rows = [
        f"| [{rule.id}]({family.family}.md#{_anchor(rule)}) | {rule.name} | {rule.severity} | "
        f"{_cell(rule.statement)} |\n"
        for family in rule_set.families
        for rule in family.rules
    ]
    families = [
        f"- [{family.title}]({family.family}.md) (`{family.family}`): {family.description}\n"
        for family in rule_set.families
    ]
    head = _INDEX_HEAD.format(rules=len(rule_set.rules), families=len(rule_set.assays))
    return f"{_HEAD}\n\n{head}{''.join(rows)}\n## Families\n\n{''.join(families)}{_WAIVING}"


_INDEX_HEAD = """\
# Rules

{rules} rules: of {families} assay families, and of handling, which concerns every protocol. \
A rule is data: a JSON file per family in `rules/` names the words that reveal the family, the \
roles that its wells play, and its rules; each rule names [checks](checks.md) and their \
parameters. All that such a file may hold: [fields](fields.md). `aegis-ot explain RULE` shows a \
rule in the terminal.

| rule | name | severity | statement |
|---|---|---|---|
"""
_WAIVING = """
## Waiving a rule

On the line concerned, on a line of its own above it, or at the top of the file:

```python
# aegis: ignore[SD-5] one tip per series is accepted in this teaching protocol
```

A reason is required, and a waiver that covers nothing is reported. For a project:

```toml
[tool.aegis-ot]
ignore = ["GEN-3"]

[tool.aegis-ot.severity]
PCR-6 = "error"

[[tool.aegis-ot.waivers]]
rules = ["SD-5"]
files = ["tutorials/*.py"]
reason = "One tip per series is how we teach it."
```
"""


def _family(family: Family) -> str:
    rules = "".join(_rule(family, rule) for rule in family.rules)
    roles = "".join(
        f"| `{name}` | {role.title} | {', '.join(role.parents)} | {_words(role)} |\n"
        for name, role in family.roles.items()
    )
    return f"""{_HEAD}

# {family.title}

{family.description} Family `{family.family}`.

{rules}## Roles

| role | meaning | also counts as | words that name it |
|---|---|---|---|
{roles}"""


def _words(role: RoleSpec) -> str:
    shown = ", ".join(role.words[:12])
    more = f" and {len(role.words) - 12} more" if len(role.words) > 12 else ""
    if not role.words and role.receives:
        return f"follows from receiving {', '.join(role.receives)}"
    return _cell(shown + more)


def _rule(family: Family, rule: RuleSpec) -> str:
    parts = [
        f"## {rule.id} {rule.name}",
        f"**{rule.severity}**. {rule.statement}",
        f"**Why.** {rule.rationale}",
        f"**Fix.** {rule.fix}",
        f"**Reference.** {rule.reference}",
    ]
    if rule.scope == "all":
        parts.append("Judged in protocols of every family.")
    if rule.needs:
        needs = needs_in_words(family, rule)
        parts.append(f"Needs to know: {needs}. Otherwise it is undecided.")
    if rule.unless_reported:
        others = ", ".join(rule.unless_reported)
        parts.append(f"Not reported for wells that are already reported under {others}.")
    parts.append("Decided by:")
    parts.append("\n".join(f"- {_check(check)}" for check in rule.checks))
    for kind, example in shown_examples(family, rule):
        parts.append(f"{kind}: {example.title}")
        parts.append(f"```python\n{code_of(example)}\n```")
    return "".join(f"{part}\n\n" for part in parts)


def _check(check: Mapping[str, Any]) -> str:
    parameters = "; ".join(
        f"{key} = {json.dumps(value, ensure_ascii=False)}"
        for key, value in check.items()
        if key != "check"
    )
    shown = f": `{parameters}`" if parameters else ""
    return f"[`{check['check']}`](checks.md#{check['check']}){shown}"


_CHECKS_HEAD = """\
# Checks

The vocabulary that rules are made of. Lists of roles are names of the family's roles; \
parameters may be left out where it says so.
"""


def _checks(rule_set: RuleSet) -> str:
    parts = [f"{_CODE_HEAD}\n\n{_CHECKS_HEAD}"]
    for name, check in CHECKS.items():
        users = [r.id for r in rule_set.rules if any(c["check"] == name for c in r.checks)]
        text, _, _ = _documentation(check).partition("\n\nAttributes:\n")
        fields = "".join(
            f"- `{parameter}`{_OPTIONAL.get(default, f' ({default} if left out)')}: {meaning}\n"
            for parameter, (default, meaning) in parameters(check).items()
        )
        fields += "\n" if dataclasses.fields(check) else ""
        used = f"Used by: {', '.join(users) or 'no shipped rule'}."
        parts.append(f"\n## {name}\n\n{text}\n\n{fields}{used}\n")
    return "".join(parts)


def _documentation(check: type) -> str:
    return (inspect.getdoc(check) or "").replace("``", "`")


def _anchor(rule: RuleSpec) -> str:
    """As GitHub makes it of a heading."""
    return re.sub(r"[^\w\- ]", "", f"{rule.id} {rule.name}").lower().replace(" ", "-")


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")
