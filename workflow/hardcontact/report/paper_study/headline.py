"""What the headline of the paper's study says. Its words are in paper_headline.txt."""

from collections.abc import Mapping
from typing import Any

from hardcontact.base.number import Number
from hardcontact.paper.claims.verdicts import UNDECIDED

#: Without one of these numbers the headline does not mention the band.
BAND_NUMBERS = {"band_force_ratio", "outermost_short_edge", "outermost_long_edge"}
#: How many times longer yielding, and the range of adhesion, make the averaged short edge.
SHIFTS = ("plasticity_shift", "range_shift")
SENSITIVITIES = ("octave_1_sensitivity", "octave_2_sensitivity", "octave_3_sensitivity")
#: With fewer masters of each coating intervals are wide, because Student's t is large.
MIN_MASTERS = 4


def headline_facts(
    numbers: Mapping[str, Number],
    coating_numbers: Mapping[str, Mapping[str, Number]],
    claims: Mapping[str, Mapping[str, Any]],
    set_count: int,
) -> dict[str, Any]:
    """Return the facts that only paper_headline.txt shows, by the names that it uses.

    `numbers` are those of the whole study, `coating_numbers` those of each coating by its label.
    `claims` are the rows of `claim_facts`, or empty if the study is not judged.
    """
    undecided = {claim for claim, row in claims.items() if row["verdict"] == UNDECIDED}
    facts: dict[str, Any] = {
        "undecided": undecided,
        "agreeing_sets": agreeing_sets(claims, set_count),
        "has_few_masters": numbers["masters"].value < MIN_MASTERS,
        "coating_count": len(coating_numbers),
        "outermost_coatings": outermost_coatings(coating_numbers),
        # Whether more roughness means less force in each of the strongest octaves.
        "roughness_lowers_force": all(numbers[name].value < 0 for name in SENSITIVITIES),
        "has_shifts": numbers.keys() >= set(SHIFTS),
        "has_band": numbers.keys() >= BAND_NUMBERS,
        "crossed_limits": [],
    }
    if facts["has_shifts"]:
        # A shift of 1 would mean that the reason has no effect.
        facts["both_reasons_hold"] = all(numbers[name].low > 1 for name in SHIFTS)
    if facts["has_band"]:
        # Few masters would be another reason why the verdict on the long edge is open.
        facts["rests_on_chance"] = (
            "outermost_long_edge" in undecided
            and numbers["outermost_long_edge"].source == "artificial"
            and not facts["has_few_masters"]
        )
        if "band_is_sufficient" in undecided:
            facts["crossed_limits"] = crossed_limits(
                numbers["band_force_ratio"], claims["band_is_sufficient"]
            )
    return facts


def agreeing_sets(claims: Mapping[str, Mapping[str, Any]], set_count: int) -> dict[str, int]:
    """Return the number of sets that agree with each claim whose verdict comes from sets."""
    shares = {claim: row["agreeing_share"] for claim, row in claims.items()}
    return {claim: round(share * set_count) for claim, share in shares.items() if share is not None}


def outermost_coatings(coating_numbers: Mapping[str, Mapping[str, Number]]) -> dict[str, str]:
    """Return the label of the coating with each outermost edge, by the name of this edge."""
    return {
        f"outermost_{edge}": outermost(
            coating_numbers, key=lambda label: coating_numbers[label][edge].value
        )
        for edge, outermost in {"short_edge": min, "long_edge": max}.items()
    }


def crossed_limits(number: Number, claim: Mapping[str, Any]) -> list[float]:
    """Return the limits of the accepted numbers of a claim within the interval of its number."""
    limits = (claim["accepted_low"], claim["accepted_high"])
    return [limit for limit in limits if number.low < limit < number.high]
