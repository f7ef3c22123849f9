"""Builds Layer 1's requests: what is the same for every protocol first, the protocol last.

The protocol and everything derived from it stands between two markers that carry a hash of all
that stands between them. No text there can hold them, since it would have to hold its own hash;
so no comment, string, label or labware name can end the data and begin to speak as the reviewer.
Every source line starts with its number, which the author cannot leave out either.
"""

from __future__ import annotations

import hashlib

from ..preflight.opinion import rule_text
from ..preflight.rule_set import RuleSet
from ..preflight.rules import Family
from ..preflight.source import source_lines
from ..vocabulary import Dossier, one_line
from .answer import ANSWER_SCHEMA
from .backend import Message, Passage, Request
from .prompts_text import prompt

PURPOSE = "layer1"


def hybrid_request(dossier: Dossier, rule_set: RuleSet) -> Request:
    """Rules, API reference, source, trace, roles, open questions."""
    extra = [brief.text for brief in dossier.rules if brief.text]
    parts = [
        fenced([*source_part(dossier), *_trace(dossier), *_roles(dossier), *_doubts(dossier)]),
        "\n".join(_asked(dossier)),
    ]
    if extra:
        parts.insert(0, "Rules of this laboratory, beside those above:\n" + "\n".join(extra))
    return Request(
        PURPOSE,
        system_passages(prompt("instructions"), rules_text(rule_set)),
        (Message(("\n\n".join(parts),)),),
        ANSWER_SCHEMA,
    )


def rules_text(rule_set: RuleSet) -> str:
    """All rules, by family, with the roles that the families know."""
    lines = ["# Rules", ""]
    for family in rule_set.assays:
        lines.append(f"## {family.family}: {family.title}")
        lines.append(_roles_by_side(family))
        for rule in family.rules:
            scope = " [all families]" if rule.scope == "all" else ""
            lines.append(f"- {rule_text(rule)}{scope}")
        lines.append("")
    return "\n".join(lines).strip()


def _roles_by_side(family: Family) -> str:
    sides = {"source": "drawn from", "destination": "filled", "any": "either"}

    needed = {role for rule in family.rules for need in rule.needs for role in need.split("|")}

    def named(name: str) -> str:
        serves = sorted((family.closure(name) - {name}) & needed)
        return f"{name} (is {', '.join(serves)})" if serves else name

    listed = (
        (told, [named(name) for name, role in family.roles.items() if role.side == side])
        for side, told in sides.items()
    )
    return "Roles: " + "; ".join(f"{told}: {', '.join(names)}" for told, names in listed if names)


def system_passages(task: str, rules: str) -> tuple[Passage, ...]:
    """What stands before each question: the task, the API reference, and the rules."""
    return (
        Passage(f"{task}\n\n{prompt('opentrons_api')}", cached=True),
        Passage(rules, cached=True),
    )


def fenced(lines: list[str]) -> str:
    """The protocol, and what is derived from it, between its markers; see the module."""
    text = "\n".join(lines)
    mark = "protocol-" + hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()[:16]
    return "\n".join([f"<{mark}>", *lines, f"</{mark}>"])


def source_part(dossier: Dossier) -> list[str]:
    """The source, each line with its number."""
    # The file's name stays out: it says nothing about the steps, and a copy of a protocol
    # should find the answer that its original got.
    lines = ["Source:"]
    lines += [f"{n}|{_visible(text)}" for n, text in enumerate(source_lines(dossier.source), 1)]
    if dossier.parameters not in ("", "{}"):
        lines.append(f"Runtime parameters: {_flat(dossier.parameters)}")
    return lines


def _trace(dossier: Dossier) -> list[str]:
    deck = [f"{item.slot}: {_flat(item.label)} ({item.load_name})" for item in dossier.deck]
    return ["", "Deck: " + "; ".join(deck), "Trace:", *dossier.table]


def _roles(dossier: Dossier) -> list[str]:
    if not dossier.roles:
        return ["", "Roles: none are known."]
    told = [f"{role.role}: {role.places} by {_flat(role.evidence)}" for role in dossier.roles]
    return ["", "Roles and their evidence:", *told]


def _doubts(dossier: Dossier) -> list[str]:
    """Why the checks could not decide; names labels and wells, so it stays within the fence."""
    if not dossier.questions:
        return []
    told = [f"{question.rule}: {_flat(question.reason)}" for question in dossier.questions]
    return ["", "Why the checks left rules open:", *told]


def _asked(dossier: Dossier) -> list[str]:
    sure = "known" if dossier.family_known else "a guess"
    lines = [f"Family by the checks: {dossier.family} ({sure})."]
    decided = [brief.id for brief in dossier.rules if brief.decided]
    lines.append(f"Decided by the checks: {', '.join(decided) or 'none'}.")
    for finding in dossier.findings:
        where = ", ".join(map(str, finding.lines))
        lines.append(f"Found by the checks: {finding.rule}, lines {where}.")
    questions = [question.rule for question in dossier.questions]
    lines.append(f"Open questions, one answer each: {', '.join(questions) or 'none'}.")
    if dossier.wanted:
        lines.append(f"Roles that these lack, by rule: {'; '.join(dossier.wanted)}.")
    return lines


def _visible(line: str) -> str:
    """A source line without characters that could pass for the end of it."""
    return "".join(c if c.isprintable() or c == "\t" else " " for c in line)


def _flat(text: str) -> str:
    """Text that may come from the protocol, on one line."""
    return one_line(text, 160)
