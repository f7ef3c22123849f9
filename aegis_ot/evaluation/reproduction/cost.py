"""How many wells are routed to a gate, and what asking a model about them costs (paper, Cost)."""

from __future__ import annotations

import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ...reasoning import (
    Backend,
    PriceTable,
    Reply,
    Request,
    State,
    Usage,
    load_prices,
    request_size,
)
from .context import Context
from .experiment import NOT_RUN, Experiment, Outcome, Table, table
from .jury import MODEL_POINTS, Heard, Word, after_calibration, analysers, judged_run, points_of
from .live import REAGENTS, script_of

SEED = 96_000
"""Of the runs; nothing was tuned on them."""

PAPER_CALL = 0.108
"""The paper's price of a call, USD (Claude Opus 4.7, three assessments)."""

PRICED = "claude-opus-4-7"
ANSWER_TOKENS = 300
"""Of three assessments, about: what the estimate takes for an answer."""

PLATE = 96


@dataclass
class Nobody:
    """Stands where a model would be: counts the questions and their size, answers none."""

    name: str = "a model"
    tokens: list[int] = field(default_factory=list)

    def ask(self, request: Request) -> Reply:
        """No answer: the well goes to the operator, who finds it right."""
        self.tokens.append(request_size(request).total)
        return Reply(State.NO_MODEL, self.name, detail="It is only counted.", attempts=0)


@dataclass(frozen=True)
class Routed:
    """What one operating point did with the sound wells of whole plates.

    Attributes:
        wells: After calibration.
        to_gate: Of these, to a gate.
        calls: Of a model, on all wells.
        plates: How many.
        held: Sound wells at which the run was held (but for a model that gives no answer).
        spent: By the price table, USD; ``None`` without an answer or a price.
    """

    wells: int
    to_gate: int
    calls: int
    plates: int
    held: int
    spent: float | None

    @property
    def share(self) -> float:
        """Of the wells after calibration, 0 to 1."""
        return self.to_gate / self.wells if self.wells else 0.0

    def calls_a_plate(self, filled: int) -> float:
        """Questions about a whole plate, of which ``filled`` wells were run."""
        return self.calls / self.plates * PLATE / filled


def run(context: Context) -> Outcome:
    """One plate of sound wells of each reagent, the same frames for all operating points."""
    nobody, heard = Nobody(), [Heard(backend) for backend in context.backends]
    asked: Sequence[Backend] = [nobody, *heard]
    points = analysers({}, points_of(asked))
    wells = context.options.wells
    context.progress.begin(f"Whole plates, {wells} wells each", len(REAGENTS))
    words: dict[str, dict[str, list[Word]]] = {}
    for number, reagent in enumerate(REAGENTS):
        script = script_of(reagent, wells, 100.0)
        words[reagent] = judged_run(script, SEED + 10 * context.options.seed + number, points)
        context.progress.step()
    silent = {point for one in heard if not one.answered for point in points_of([one])}
    found = {
        point: {reagent: _routed([words[reagent][point]]) for reagent in REAGENTS}
        | {"all": _routed([words[reagent][point] for reagent in REAGENTS])}
        for point in points
        if point not in silent
    }
    tokens = statistics.median(nobody.tokens) if nobody.tokens else 0.0
    call = _price(load_prices(), tokens)
    return Outcome(
        data=(
            f"simulated: robot and camera (1280x720, grey panel), {wells} sound wells of each "
            "reagent, p1000, 100 µL",
        ),
        answers={"routed": _answer(found, wells)},
        tables=(_shares(found), _costs(found, wells, call), _models(context, silent)),
        notes=(
            "Questions are counted on sound wells; nobody answers them here unless a model is "
            "given. The paper's plate costs are its routed share times 96 times the call.",
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
                for point, by in found.items()
            },
            "tokens_a_call": tokens,
            "price_a_call": call,
        },
    )


def _routed(runs: Sequence[Sequence[Word]]) -> Routed:
    later = [word for words in runs for word in after_calibration(words)]
    every = [word for words in runs for word in words]
    costs = [cost for word in every for cost in word.costs]
    amounts = [cost["amount"] for cost in costs]
    answered = any(cost["tokens_in"] for cost in costs)
    spent = None if not answered or None in amounts else float(sum(amounts))
    return Routed(
        len(later),
        sum(word.routed for word in later),
        len(costs),
        len(runs),
        sum(word.held for word in every),
        spent,
    )


def _price(prices: PriceTable, tokens: float) -> float | None:
    return prices.cost(PRICED, Usage(input=round(tokens), output=ANSWER_TOKENS))


Found = Mapping[str, Mapping[str, Routed]]


def _shares(found: Found) -> Table:
    rows = [
        (point, *(f"{by[name].share:.1%} ({by[name].to_gate}/{by[name].wells})" for name in by))
        for point, by in found.items()
    ]
    header = ("operating point", *REAGENTS, "all")
    return table("Sound wells sent to a gate (the paper: 15.7 % of wells)", header, rows)


def _costs(found: Found, wells: int, call: float | None) -> Table:
    rows = []
    for point, by in found.items():
        calls = by["all"].calls_a_plate(wells)
        spent = by["all"].spent
        plate = None if spent is None else spent / by["all"].plates * PLATE / wells
        rows.append(
            (
                point,
                f"{calls:.1f}",
                f"{calls * PAPER_CALL:.2f}",
                "unknown" if call is None else f"{calls * call:.2f}",
                f"{NOT_RUN}: nobody was asked" if plate is None else f"{plate:.2f}",
                "10.33" if point.startswith("always") else "1.63",
            )
        )
    header = (
        "operating point",
        "questions a plate of 96",
        f"USD at the paper's {PAPER_CALL}",
        f"USD, {PRICED}, estimate",
        "USD, as answered",
        "paper, USD",
    )
    return table("Cost of a plate", header, rows)


def _models(context: Context, silent: set[str]) -> Table:
    if not context.backends:
        rows = [(form.format("MODEL"), f"{NOT_RUN}: no model") for form in MODEL_POINTS]
    else:
        rows = [(point, f"{NOT_RUN}: the model gave no answer") for point in sorted(silent)]
    header = ("operating point", "state")
    return table("With a model that answers", header, rows or [("all", "run, see above")])


def _answer(found: Found, wells: int) -> str:
    told = []
    for point, by in found.items():
        calls = by["all"].calls_a_plate(wells)
        told.append(
            f"{point}: {by['all'].share:.1%} of sound wells to a gate, {calls:.1f} questions a "
            f"plate, {calls * PAPER_CALL:.2f} USD at the paper's price of a call"
        )
    return "; ".join(told)


EXPERIMENT = Experiment(
    "cost",
    "Routed fraction and cost of a plate",
    "Live demonstration, Cost",
    ("routed",),
    ("models", "wells"),
    run,
)
