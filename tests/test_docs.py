"""What the documentation says of settings and commands is what the code has."""

from __future__ import annotations

import re
from dataclasses import fields
from pathlib import Path

import pytest

from aegis_ot.preflight.rules import Family
from aegis_ot.settings import Settings
from aegis_ot.sidecar.config import ENVIRONMENT, SidecarConfig
from aegis_ot.workbench.configuration import read_configuration
from scripts.cli_reference import root
from scripts.sentences import MOST, MOST_ON_AVERAGE, measured, pages, sentences, words

ROOT = Path(__file__).resolve().parent.parent
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])


def rows(text: str) -> dict[str, str]:
    """Default by setting, from the tables."""
    return dict(re.findall(r"^\| `(\w+)` \| (.*?) \|", text, re.MULTILINE))


def test_every_setting_of_the_guard_is_there_with_its_default():
    text = (ROOT / "docs" / "reference" / "settings.md").read_text(encoding="utf-8")
    told = rows(text[: text.index("## Sidecar")])
    assert set(told) == {field.name for field in fields(Settings)}
    for name, default in told.items():
        value = getattr(Settings(), name)
        if not value and not isinstance(value, bool):
            assert default == "none"
        else:
            shown = f'"{value}"' if isinstance(value, str) else str(value).lower()
            assert default == f"`{shown}`"


def test_every_setting_of_the_sidecar_is_there():
    text = (ROOT / "docs" / "reference" / "settings.md").read_text(encoding="utf-8")
    text = text[text.index("## Sidecar") :]
    for variable, place in ENVIRONMENT.items():
        assert f"| `{variable}` | `{'.'.join(place)}` |" in text
    for name, field in SidecarConfig.model_fields.items():
        inner = getattr(field.annotation, "model_fields", None)
        part = text.split(f"### `[{name}]`")[1].split("###")[0] if inner else text
        for setting in inner or [name]:
            assert setting in rows(part)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_and_named_files_exist(page):
    text = page.read_text(encoding="utf-8")
    for link in re.findall(r"\]\(([^)#]+)", text):
        if not link.startswith("http"):
            assert (page.parent / link).exists(), link
    for path in re.findall(r"(?<![\w/])examples/[\w./-]+\w", text):
        assert (ROOT / path).exists(), path


def test_the_readme_shows_the_example_as_it_is():
    example = (ROOT / "examples" / "demo" / "hello_guard.py").read_text(encoding="utf-8")
    code = example[example.index("from aegis_ot") :]
    assert code in (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_project_table_that_is_shown_is_accepted(tmp_path):
    tomllib = pytest.importorskip("tomllib")
    text = (ROOT / "docs" / "how-to" / "check.md").read_text(encoding="utf-8")
    (shown,) = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    table = tomllib.loads(shown)["tool"]["aegis-ot"]
    configuration = read_configuration(table, tmp_path, "pyproject.toml")
    for field in fields(configuration):
        assert field.name == "folder" or getattr(configuration, field.name), field.name


@pytest.mark.parametrize("page", ["check.md", "ci.md", "robot.md"])
def test_every_option_that_is_shown_exists(page):
    text = (ROOT / "docs" / "how-to" / page).read_text(encoding="utf-8")
    known = {
        option
        for command in root().commands.values()
        for part in (command, *getattr(command, "commands", {}).values())
        for parameter in part.params
        for option in parameter.opts
    }
    shown = set(re.findall(r"(?<![\w-])--[a-z][a-z-]+", text))
    assert shown - known == set()
    assert len(shown) > 3


def test_rule_files_are_told_of_with_all_their_fields():
    part = (ROOT / "docs" / "how-to" / "rules-of-your-own.md").read_text(encoding="utf-8")
    assert {"../rules/fields.md", "../rules/checks.md"} <= set(re.findall(r"\]\(([^)#]+)", part))
    plain = {"family", "title", "description", "schema", "path"}
    for name in {field.name for field in fields(Family)} - plain:
        assert f"`{name}`" in part, name


def test_the_action_installs_extras_that_exist_and_calls_a_command_that_exists():
    yaml = pytest.importorskip("yaml")
    action = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
    install, check = (step["run"] for step in action["runs"]["steps"])
    assert "$GITHUB_ACTION_PATH[$ROBOT,check]" in install
    _, command, option, form, *rest = check.split()
    assert (option, form, rest) == ("--format", "github", ["$ARGUMENTS", "$FILES"])
    assert command in root().commands
    said = (ROOT / "docs" / "how-to" / "ci.md").read_text(encoding="utf-8")
    assert set(action["inputs"]) <= set(re.findall(r"\w+", said))


def test_no_page_names_an_address_that_nobody_has_given():
    for page in (*PAGES, ROOT / "mkdocs.yml", ROOT / "action.yml"):
        assert "example.org" not in page.read_text(encoding="utf-8"), page


def test_readme_tutorial_and_how_tos_are_read_once():
    lengths = []
    for page in pages():
        _, longest, too_long = measured(page)
        assert longest <= MOST, f"{page}: {too_long}"
        lengths += [words(one) for one in sentences(page.read_text(encoding="utf-8"))]
    assert sum(lengths) / len(lengths) <= MOST_ON_AVERAGE


@pytest.mark.parametrize(
    ("text", "lengths"),
    [
        ("One two. Three four five.\n\n# A heading\n\n| a | table |\n", [2, 3]),
        ("- An item\n- of a [list](link.md) with `some code of one word`.\n", [2, 5]),
        ("It says: *B3 got nothing.* Then 2.5 µL are left; and so on.\n", [2, 3, 8]),
        ("```sh\nno prose at all\n```\n", []),
    ],
)
def test_sentences_are_counted_as_a_reader_reads_them(text, lengths):
    assert [words(one) for one in sentences(text)] == lengths


def test_the_pre_commit_hook_calls_a_command_that_exists_with_extras_that_exist():
    text = (ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8")
    (entry,) = re.findall(r"^  entry: aegis-ot (\S+)$", text, re.MULTILINE)
    assert entry in root().commands
    (extras,) = re.findall(r'additional_dependencies: \["\.\[(.*?)\]"\]', text)
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    for extra in extras.split(","):
        assert re.search(rf"^{extra} = \[", project, re.MULTILINE)
