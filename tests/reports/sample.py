"""A check run made by hand: one of everything that a renderer has to show."""

from __future__ import annotations

from aegis_ot.preflight import Report, RuleSet
from aegis_ot.preflight.judging import RoleEvidence, Waived, Waiver
from aegis_ot.preflight.roles import Inference
from aegis_ot.preflight.rules import Common, Example, Examples, Family, RoleSpec, RuleSpec
from aegis_ot.vocabulary import Finding, Remark, Severity, Site, Undecided, VerdictWord, WellRef
from aegis_ot.workbench import CheckedProtocol, CheckRun, Exploration, Problem
from aegis_ot.workbench.result import Broken


def rule(name: str, title: str, severity: str = "error", scope: str = "family") -> RuleSpec:
    return RuleSpec(
        id=name,
        name=title,
        statement=f"The statement of {name}.",
        severity=severity,
        needs=("ntc", "template|water"),
        checks=({"check": "carry", "carried": ["template"], "into": ["ntc"]},),
        rationale=f"Why {name} matters.",
        reference="A book | page 3.",
        fix=f"How to mend {name}.",
        examples=Examples(
            (Example("a good one", ("a = 1", "b = 2")),), (Example("a bad one", ("a = 2",)),)
        ),
        scope=scope,
        unless_reported=("PCR-4",) if name == "PCR-2" else (),
    )


FAMILY = Family(
    family="pcr",
    title="PCR set-up",
    description="Master mix and template.",
    signals=(),
    roles={
        "ntc": RoleSpec("no-template control", words=("ntc", "blank")),
        "template": RoleSpec("template", words=("dna",)),
        "water": RoleSpec("water", parents=("template",), words=("water", "h2o")),
    },
    rules=(
        rule("PCR-2", "fresh-tip-template-to-ntc"),
        rule("PCR-6", "uniform-reaction-volume", "warning"),
        rule("PCR-1", "master-mix-everywhere"),
    ),
)
GENERIC = Family(
    "generic", "Transfers", "Anything.", (), FAMILY.roles, (rule("GEN-3", "volumes", scope="all"),)
)
DATABASE = RuleSet((FAMILY, GENERIC), Common())

LINES = (
    'metadata = {"apiLevel": "2.15"}',
    "",
    "def run(protocol):",
    "    p20.pick_up_tip()",
    "    p20.aspirate(5, template)  # 50% of it, 5 µL",
    "    for well in wells:",
    "        p20.dispense(5, well)",
    "\tp20.mix(3, 10, ntc)",
)


def well(name: str, slot: str = "3", label: str = "PCR plate") -> WellRef:
    return WellRef(f"labware-{slot}", name, label, slot)


CARRY = Finding(
    "PCR-2",
    Severity.ERROR,
    "The tip that drew template from B1 at line 5 entered the NTC H12 at line 8.",
    (
        Site(5, well("B1", "2", "tubes"), "met template"),
        Site(8, well("H12"), "entered the NTC"),
        Site(8, well("G12"), "entered the NTC"),
    ),
    why="Why PCR-2 matters, 100 %: <a> & b.",
    fix="How to mend PCR-2.",
)
UNEVEN = Finding(
    "PCR-6",
    Severity.WARNING,
    "A1 ends at 17 µL, the others at 20 µL.",
    (Site(7, well("A1"), "received 2 µL"),),
)
PLACELESS = Finding("GEN-3", Severity.ERROR, "A tube overflows.", (Site(None),))

FAMILIES = (
    Inference("pcr", 9.0, 0.97, ("'pcr' in a name", "'ntc' in a name"), True, True),
    Inference("generic", 0.0, 0.0, (), False, False),
)

ROLES = (
    RoleEvidence("pcr", well("H12"), "ntc", ("name `ntc` at line 3",), None, "label 'samples'"),
    RoleEvidence("pcr", well("A1"), "standard", ("name `std`",), 0.5),
    RoleEvidence("pcr", well("B1"), "standard", ("name `std`",), 0.5),
)


def report(*findings: Finding, **more: object) -> Report:
    word = VerdictWord.PASS
    if findings:
        word = VerdictWord.FAIL if CARRY in findings else VerdictWord.WARN
    settled = {"undecided": (), "judged": ("PCR-1", "PCR-2", "PCR-6", "GEN-3"), **more}
    return Report("f.py", "pcr", word, findings, families=FAMILIES, **settled)  # type: ignore[arg-type]


RUN = CheckRun(
    (
        CheckedProtocol("protocols/clean.py", report(), lines=LINES, seconds=0.25),
        CheckedProtocol(
            "protocols/bad, odd.py",
            report(
                CARRY,
                UNEVEN,
                undecided=(Undecided("PCR-1", "nothing says which well is the master mix"),),
                waived=(Waived(PLACELESS, Waiver(1, (), ("GEN-3",), "the tube is a bottle")),),
                judged=("PCR-2", "PCR-6", "GEN-3"),
                remarks=(Remark("The waiver of PCR-5 is stale: nothing is found there.", 2),),
                notes=("a model: nothing else to say",),
                roles=ROLES,
            ),
            lines=LINES,
            seconds=0.5,
        ),
        CheckedProtocol(
            "protocols/varied.py",
            report(UNEVEN),
            lines=LINES,
            seconds=2.0,
            baselined=(CARRY,),
            settled=(
                Remark("The baseline lists a finding that no longer occurs here; write it anew."),
            ),
            exploration=Exploration(
                runs=5,
                combinations=6,
                parameters={"tips": ("always", "once"), "n": (1, 2, 3)},
                broken=(Broken("PCR-6", "tips=once", 2),),
                failures=(("n=3", Problem("ValueError: too many", 4)),),
                not_varied=("name: left as it is; it declares neither choices nor bounds",),
            ),
        ),
        CheckedProtocol(
            "/abs/broken file.py",
            problem=Problem("not valid Python: '(' was never\nclosed", 3),
            lines=LINES,
        ),
        CheckedProtocol("missing.py", problem=Problem("there is no such file.")),
    ),
    DATABASE,
    "1.2.3",
    explain_roles=True,
)
