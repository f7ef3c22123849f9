"""A person's decision is on the row: it changes what was flagged, never what was not seen."""

from __future__ import annotations

from aegis_ot.sidecar.decisions import effective
from aegis_ot.vocabulary import ChannelOutcome, ChannelVerdict, Outcome, Route, Verdict

WORDS = {".": "pass", "F": "fail", "?": "undecided", "u": "unobserved"}


def decided(outcome: Outcome, told: str, decision: str) -> str:
    channels = tuple(
        ChannelVerdict(f"{row}1", None, ChannelOutcome(WORDS[sign]))
        for row, sign in zip("ABCDEFGH", told, strict=False)
    )
    verdict = Verdict("run", 0, outcome, Route.GREY_ZONE, channels=channels)
    now = effective(verdict, [{"outcome": decision, "by": "Ada", "note": ""}])
    assert now.outcome.value == decision
    signs = {word: sign for sign, word in WORDS.items()}
    return "".join(signs[channel.outcome.value] for channel in now.channels)


def test_a_pass_clears_what_was_flagged() -> None:
    assert decided(Outcome.FAIL, ".F?u", "pass") == "...u"


def test_a_fail_confirms_what_was_in_doubt() -> None:
    assert decided(Outcome.UNDECIDED, ".?u", "fail") == ".Fu"


def test_a_fail_of_a_row_that_had_passed_is_one_of_every_tip_that_was_seen() -> None:
    assert decided(Outcome.PASS, "..u", "fail") == "FFu"
