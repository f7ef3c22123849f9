"""How many wells are routed to a gate, and what asking a model about them costs (paper, Cost)."""

from __future__ import annotations

import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from aegis_ot.llm import TokenUsage, load_prices

from ..evaluation.layer1.bill import cost_of
from .context import Context
from .experiment import NOT_RUN, Experiment, ExperimentOutcome, Table, table
from .jury import CountedModel, Word, after_calibration, analysers, counted, judged_run
from .live import REAGENTS, script_of, unanswered

SEED = 96_000
"""Of the runs; nothing was tuned on them."""

PAPER_CALL = 0.108
"""The paper's price of a call, USD (Claude Opus 4.7, three assessments)."""

PRICED = "claude-opus-4-7"
ANSWER_TOKENS = 300
"""Of three assessments, about: what the estimate takes for an answer."""

PLATE = 96


@dataclass(frozen=True)
class Routed:
    """What one operating point did with the sound wells of whole plates.

    Attributes:
        wells: After calibration.
        to_gate: Of these, to a gate.
    """

    wells: int
    to_gate: int

    @property
    def share(self) -> float:
        """Of the wells after calibration, 0 to 1."""
        return self.to_gate / self.wells if self.wells else 0.0


@dataclass(frozen=True)
class Asked:
    """Questions of one operating point, for a whole plate.

    Attributes:
        questions: So many.
        spent: By the price table, USD; ``None`` without an answer or a price.
    """

    questions: float
    spent: float | None


def run(context: Context) -> ExperimentOutcome:
    """One plate of sound wells of each reagent, the same frames for all operating points."""
    asking = counted([None, *context.backends])
    points = analysers(context.papers_model(), {}, asking)
    wells = context.options.wells
    context.progress.begin(f"Whole plates, {wells} wells each", len(REAGENTS))
    words: dict[str, dict[str, list[Word]]] = {}
    for number, reagent in enumerate(REAGENTS):
        script = script_of(reagent, wells, 100.0)
        words[reagent] = judged_run(script, SEED + 10 * context.options.seed + number, points)
        context.progress.step()
    silent = [p for p, one in asking.items() if p not in counted([None]) and not one.answered]
    found = {
        point: {reagent: _routed([words[reagent][point]]) for reagent in REAGENTS}
        | {"all": _routed([words[reagent][point] for reagent in REAGENTS])}
        for point in points
        if point not in silent
    }
    asked = {point: _asked(asking[point], wells) for point in found}
    tokens = statistics.median([n for one in asking.values() for n in one.tokens] or [0])
    call = load_prices().cost(PRICED, TokenUsage(input=round(tokens), output=ANSWER_TOKENS))
    return ExperimentOutcome(
        data=(
            f"simulated: robot and camera (1280x720, grey panel), {wells} sound wells of each "
            "reagent, p1000, 100 µL",
        ),
        answers={"routed": _answer(found, asked)},
        tables=(_shares(found), _costs(asked, call), unanswered(context, silent)),
        notes=(
            f"Questions of {wells} wells, told for 96. They are counted on sound wells; nobody "
            "answers them here unless a model is given. The paper's plate costs are its routed "
            "share times 96 times the call.",
            f"A question of ours holds about {tokens:.0f} tokens (estimate, four cropped "
            f"pictures); with an answer of {ANSWER_TOKENS} it comes to "
            + (f"{call:.4f} USD" if call is not None else "an unknown price")
            + f" with {PRICED} by the price table of {load_prices().as_of}.",
            "cascade asks about what the volumetric gate leaves open, about two first wells and "
            "about a share of those that pass; the paper's cascade about all outside median "
            "± 0.7·MAD; always-VLM about all after the calibration.",
        ),
        figures={
            "points": {
                point: {name: vars(one) | {"share": one.share} for name, one in by.items()}
                | vars(asked[point])
                for point, by in found.items()
            },
            "tokens_a_call": tokens,
            "price_a_call": call,
        },
    )


def _routed(runs: Sequence[Sequence[Word]]) -> Routed:
    later = [word for words in runs for word in after_calibration(words)]
    return Routed(len(later), sum(word.routed for word in later))


def _asked(one: CountedModel, wells: int) -> Asked:
    """Of runs of ``wells`` wells, one for each reagent, told for a plate of 96."""
    scale = PLATE / wells / len(REAGENTS)
    amounts = [cost_of(reply, load_prices()) for reply in one.replies]
    known = [amount for amount in amounts if amount is not None]
    spent = sum(known) * scale if one.answered and len(known) == len(amounts) else None
    return Asked(len(one.tokens) * scale, spent)


Found = Mapping[str, Mapping[str, Routed]]


def _shares(found: Found) -> Table:
    rows = [
        (point, *(f"{by[name].share:.1%} ({by[name].to_gate}/{by[name].wells})" for name in by))
        for point, by in found.items()
    ]
    header = ("operating point", *REAGENTS, "all")
    return table("Sound wells sent to a gate (the paper: 15.7 % of wells)", header, rows)


def _costs(asked: Mapping[str, Asked], call: float | None) -> Table:
    rows = [
        (
            point,
            f"{one.questions:.1f}",
            f"{one.questions * PAPER_CALL:.2f}",
            "unknown" if call is None else f"{one.questions * call:.2f}",
            f"{NOT_RUN}: nobody was asked" if one.spent is None else f"{one.spent:.2f}",
            "10.33" if point.startswith("always") else "1.63",
        )
        for point, one in asked.items()
    ]
    header = (
        "operating point",
        "questions a plate of 96",
        f"USD at the paper's {PAPER_CALL}",
        f"USD, {PRICED}, estimate",
        "USD, as answered",
        "paper, USD",
    )
    return table("Cost of a plate", header, rows)


def _answer(found: Found, asked: Mapping[str, Asked]) -> tuple[str, ...]:
    return tuple(
        f"{point}: {by['all'].share:.1%} of sound wells to a gate, {asked[point].questions:.1f} "
        f"questions a plate, {asked[point].questions * PAPER_CALL:.2f} USD at the paper's price "
        "of a call"
        for point, by in found.items()
    )


EXPERIMENT = Experiment(
    "cost",
    "Routed fraction and cost of a plate",
    "Live demonstration, Cost",
    ("routed",),
    ("models", "wells"),
    run,
)
