"""``aegis-ot explain`` and ``aegis-ot rules``: the rule database, shown, tested, documented."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import ConfigurationError
from ..preflight.rule_set import load_rules, shipped_rules
from ..reports.rule_text import rule_list, rule_text
from ..vocabulary import counted
from ..workbench.given import known_rule, split
from .exit_codes import CLEAN, FINDINGS
from .options import one_of
from .paths import write_text

if TYPE_CHECKING:
    from ..preflight import RuleSet
    from ..workbench.rule_examples import ExampleResult

RulesOption = Annotated[list[Path] | None, typer.Option(help="File or folder of further rules.")]

app = typer.Typer()
rules_app = typer.Typer(no_args_is_help=True, help="The rule database: list, test, document.")
app.add_typer(rules_app, name="rules")


@app.command()
def explain(
    rule: Annotated[str, typer.Argument(help="A rule's identifier, PCR-2.")],
    rules: RulesOption = None,
) -> None:
    """Say what a rule demands, why, how to mend a violation, and show examples."""
    rule_set = _rule_set(rules)
    typer.echo(rule_text(*rule_set.rule(known_rule(rule, rule_set))), nl=False)


@rules_app.command("list")
def list_rules(
    rules: RulesOption = None,
    output_format: Annotated[str, typer.Option("--format", "-f", help="text or json.")] = "text",
) -> None:
    """List all rules in force."""
    one_of("--format", output_format, ("text", "json"))
    rule_set = _rule_set(rules)
    if output_format == "text":
        typer.echo(rule_list(rule_set), nl=False)
        return
    entries = [
        {
            "id": rule.id,
            "name": rule.name,
            "family": family.family,
            "severity": rule.severity,
            "scope": rule.scope,
            "statement": rule.statement,
        }
        for family in rule_set.families
        for rule in family.rules
    ]
    typer.echo(json.dumps({"rules": entries}, indent=2, ensure_ascii=False))


@rules_app.command("test")
def run_rule_examples(
    path: Annotated[
        Path | None, typer.Argument(help="File or folder of rules; left out: the shipped ones.")
    ] = None,
    rules: RulesOption = None,
    select: Annotated[list[str] | None, typer.Option(help="Only these rules.")] = None,
    timeout: Annotated[
        float, typer.Option(help="Longest time for the examples of one rule, s.")
    ] = 120.0,
) -> None:
    """Run the examples that rules carry: passing ones must pass, failing ones be caught.

    Exit codes: 0 all as promised, 1 some are not, 2 a rule file is wrong.
    """
    from ..workbench import Rehearser, TaskFailed
    from ..workbench.rule_examples import ExampleResult
    from ..workbench.tasks import RunExamples

    given = [*([path] if path is not None else []), *(rules or ())]
    rule_set = _rule_set(given)
    wanted = [known_rule(rule, rule_set, "--select: ") for rule in split("--select", select)]
    if not wanted:
        wanted = _rules_of(rule_set, given)
    paths = tuple(str(p.resolve()) for p in _further(given))
    results: list[ExampleResult] = []
    with Rehearser(lasting=True) as rehearser:
        for rule in wanted:
            try:
                found = rehearser.perform(RunExamples(rule, paths, timeout))
            except TaskFailed as failed:
                found = [ExampleResult(rule, "its examples", False, False, str(failed))]
            results += found
            for result in found:
                if not result.ok:
                    typer.echo(f"{result.rule}: {result.title}: {_wrong(result)}")
    bad = sum(not result.ok for result in results)
    typer.echo(
        f"{counted(len(wanted), 'rule')}, {counted(len(results), 'example')}: "
        f"{len(results) - bad} as promised, {bad} not."
    )
    raise typer.Exit(FINDINGS if bad else CLEAN)


@rules_app.command("docs")
def write_docs(
    out: Annotated[Path, typer.Option(help="Folder for the pages.")] = Path("docs/rules"),
    rules: RulesOption = None,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; fail if a page is out of date.")
    ] = False,
) -> None:
    """Write the documentation pages of the rules from the rule files."""
    from ..reports.rule_pages import rule_pages

    pages = rule_pages(_rule_set(rules))
    if check:
        stale = [name for name, text in pages.items() if _text(out / name) != text]
        for name in stale:
            typer.echo(f"{out / name} is out of date; run: aegis-ot rules docs --out {out}")
        raise typer.Exit(FINDINGS if stale else CLEAN)
    for name, text in pages.items():
        write_text(out / name, text)
    typer.echo(f"{counted(len(pages), 'page')} in {out}")


def _text(path: Path) -> str | None:
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"{path} cannot be read: {error}") from None


def _rule_set(paths: list[Path] | None) -> RuleSet:
    return load_rules(_further(paths or []))


def _further(paths: list[Path]) -> list[Path]:
    """Without what is part of the shipped database anyway."""
    shipped = shipped_rules().resolve()
    return [p for p in paths if shipped not in (p.resolve(), *p.resolve().parents)]


def _rules_of(rule_set: RuleSet, paths: list[Path]) -> list[str]:
    """The rules of these files, or all."""
    places = [path.resolve() for path in paths]
    return [
        rule.id
        for family in rule_set.families
        for rule in family.rules
        if not places
        or any(
            place in (Path(family.path).resolve(), *Path(family.path).resolve().parents)
            for place in places
        )
    ]


def _wrong(result: ExampleResult) -> str:
    if result.problem:
        return result.problem
    return "the rule finds nothing" if result.expected else "the rule fires, and must not"
