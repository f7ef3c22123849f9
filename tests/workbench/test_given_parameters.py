"""Values that the user gives for runtime parameters: each is heard, or it is told why not."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script, record
from aegis_ot.errors import RehearsalError
from aegis_ot.preflight import load_rules
from aegis_ot.workbench import CheckRun, CheckSettings, check_files

DECLARES = """
requirements = {"robotType": "OT-2", "apiLevel": "2.20"}
def add_parameters(p):
    p.add_int("Samples", "count", default=4, minimum=1, maximum=8)
    p.add_float("Volume", "vol", default=2, minimum=1, maximum=5)
    p.add_bool("Fresh tips", "fresh", default=True)
    p.add_str("Mount", "mount", default="left", choices=[
        {"display_name": "L", "value": "left"}, {"display_name": "R", "value": "right"}])
    p.add_csv_file("Table", "table")
def run(protocol):
    if protocol.params.count > 6:
        raise ValueError("too many")
    if protocol.params.count > 5:
        protocol.params.table.parse_as_csv()
"""
PLAIN = 'metadata = {"apiLevel": "2.15"}\ndef run(protocol): ...\n'


def check(folder: Path, texts: list[str], **values: Any) -> CheckRun:
    files = [folder / f"p{number}.py" for number in range(len(texts))]
    for file, text in zip(files, texts, strict=True):
        file.write_text(text, encoding="utf-8")
    return check_files(files, CheckSettings(timeout_s=60, **values), load_rules())


@pytest.mark.parametrize(
    ("name", "value", "takes"),
    [
        ("count", 9, "a whole number from 1 to 8"),
        ("count", "many", "a whole number from 1 to 8"),
        ("vol", 0.5, "a number from 1 to 5"),
        ("fresh", "yes", "True or False"),
        ("mount", "middle", "one of left, right"),
    ],
)
def test_a_value_that_is_refused_is_told_with_its_name_and_what_is_taken(
    name: str, value: Any, takes: str
) -> None:
    with pytest.raises(RehearsalError) as caught:
        record(Script(DECLARES, "p.py", {name: value}))
    told = f"p.py: the runtime parameter {name} cannot be {value!r}; it takes {takes}."
    assert str(caught.value) == told


@pytest.mark.parametrize(
    ("text", "words"),
    [(PLAIN, "the protocol declares none"), (DECLARES, "there are count, vol, fresh, mount")],
)
def test_a_value_without_a_parameter_is_an_error(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(RehearsalError, match=words):
        record(Script(text, "p.py", {"foo": 3}))
    run = check(tmp_path, [text], parameters={"foo": 3})
    (problem,) = (protocol.problem for protocol in run.protocols)
    assert run.exit_code == 2
    assert problem is not None
    assert problem.message.startswith("there is no parameter foo; ")
    assert words in problem.message


def test_of_several_protocols_each_takes_the_values_that_are_for_it(tmp_path: Path) -> None:
    run = check(tmp_path, [PLAIN, DECLARES], parameters={"count": 7})
    plain, declares = run.protocols
    assert plain.problem is None
    assert declares.problem is not None
    assert "too many" in declares.problem.message
    assert check(tmp_path, [PLAIN, DECLARES], parameters={"count": 3}).exit_code == 0
    nobodys = check(tmp_path, [PLAIN, DECLARES], parameters={"count": 3, "foo": 3})
    assert ["foo" in (c.problem.message if c.problem else "") for c in nobodys.protocols] == [
        True,
        True,
    ]


def test_a_misspelt_file_is_named_though_the_rehearsal_lacks_the_right_one(tmp_path: Path) -> None:
    file = tmp_path / "table.csv"
    file.write_text("1,2\n", encoding="utf-8")
    text = DECLARES.replace("count", "extra")
    (checked,) = check(tmp_path, [text], csv_parameters={"tabel": file}).protocols
    assert checked.problem is not None
    assert checked.problem.message.startswith("there is no parameter tabel; there are ")


def test_no_protocol_is_accused_while_another_one_may_declare_the_parameter(tmp_path: Path) -> None:
    plain, broken = check(tmp_path, [PLAIN, "def run(p:\n"], parameters={"foo": 3}).protocols
    assert plain.problem is None
    assert broken.problem is not None


def test_parameters_that_cannot_be_read_are_told_with_their_line(tmp_path: Path) -> None:
    text = DECLARES.replace("minimum=1, maximum=8", "")
    (checked,) = check(tmp_path, [text], parameters={"count": 3}).protocols
    assert checked.problem is not None
    assert checked.problem.line == 4
    told = "the runtime parameters cannot be read: ParameterDefinitionError: Must provide"
    assert checked.problem.message.startswith(told)


def test_a_csv_parameter_is_told_with_the_option_that_gives_it(tmp_path: Path) -> None:
    option = "give it with --csv table=PATH."
    for values, words, line in [
        ({"count": 6}, "the CSV parameter table needs a file, and has none", 14),
        ({"table": "t.csv"}, "the CSV parameter table needs a file, not a value", None),
    ]:
        (checked,) = check(tmp_path, [DECLARES], parameters=values).protocols
        assert checked.problem is not None
        assert checked.problem.message == f"{words}; {option}"
        assert checked.problem.line == line
    table = tmp_path / "t.csv"
    table.write_text("a,b\n1,2\n", encoding="utf-8")
    given = check(tmp_path, [DECLARES], parameters={"count": 6}, csv_parameters={"table": table})
    assert given.exit_code == 0
    (wrong,) = check(tmp_path, [DECLARES], csv_parameters={"count": table}).protocols
    assert wrong.problem is not None
    assert "count takes a whole number from 1 to 8, no CSV file" in wrong.problem.message
