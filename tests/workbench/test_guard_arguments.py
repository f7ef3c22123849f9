"""What the guard inside a protocol says, as a reader of its text knows it."""

from __future__ import annotations

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.preflight import Options
from aegis_ot.workbench.guard_arguments import guard_arguments
from aegis_ot.workbench.run import options_for


def guarded(arguments: str) -> str:
    return f"from aegis_ot import guard\n\n@guard({arguments})\ndef run(protocol):\n    pass\n"


def test_literals_count_as_the_settings_read_them() -> None:
    text = guarded('assay="pcr", roles={"ntc": "plate:H12, plate:H11"}, ignore="PCR-6, SD-5"')
    options = options_for(guard_arguments(text), Options(select=("PCR-1",)))
    assert options.assay == ("pcr",)
    assert options.roles == {"ntc": ("plate:H12", "plate:H11")}
    assert options.ignore == ("PCR-6", "SD-5")
    assert options.select == ("PCR-1",)


def test_the_command_line_comes_first() -> None:
    text = guarded('assay="pcr", roles={"ntc": ["1:A1"], "water": ["1:B1"]}')
    options = options_for(
        guard_arguments(text), Options(assay=("generic",), roles={"ntc": ("2:H12",)})
    )
    assert options.assay == ("generic",)
    assert options.roles == {"ntc": ("2:H12",), "water": ("1:B1",)}


def test_guards_above_one_another_are_one_and_the_outer_comes_first() -> None:
    inner = '@guard(roles={"ntc": ["1:A1"]}, assay="generic", ignore="SD-5")\ndef run'
    read = guard_arguments(guarded('assay="pcr"').replace("def run", inner))
    assert read.unread == ()
    assert read.values == {
        "assay": "pcr",
        "roles": {"ntc": ("1:A1",)},
        "ignore": ("SD-5",),
    }


def test_what_is_worked_out_in_the_run_is_told() -> None:
    (remark,) = guard_arguments(guarded('roles=ROLES, assay="pcr"')).unread
    assert remark.message.startswith("The guard's roles is worked out in the run")
    assert remark.line == 3


def test_what_the_guard_would_refuse_is_refused() -> None:
    with pytest.raises(ConfigurationError, match=r"roles.*line 3"):
        guard_arguments(guarded('roles=["plate:H12"]'))


def test_without_a_guard_nothing_is_said() -> None:
    assert guard_arguments("def run(protocol):\n    pass\n").values == {}
    assert guard_arguments("def run(").values == {}
