"""Assumptions of the closed form on the contact alone: hard bodies and a small contact area."""

import math
from enum import StrEnum

from hardcontact.base.formatting import format_quantity
from hardcontact.base.number import Number
from hardcontact.contact.contact import Contact
from hardcontact.contact.hertz_jkr_dmt import (
    maugis_parameter,
    pull_off_coefficient,
    tabor_parameter,
)
from hardcontact.theory.closed_form import contact_term

#: Effective modulus in Pa of ruby on diamond. It stands here, too, because an installed library has
#: no resources/; a test compares it with `published.effective_modulus`.
RUBY_ON_DIAMOND_MODULUS = 1 / ((1 - 0.29**2) / 365e9 + (1 - 0.22**2) / 1010e9)
#: Hardness in Pa below which this modulus is not assumed: a tenth of the ruby's. Moduli are ten to
#: some hundred times the hardness, so that such bodies may be ten times as compliant.
SOFT_HARDNESS = 2.5e9
#: Largest relative change of the force, by missing waves or by elasticity, that is negligible.
MAX_NEGLIGIBLE_CHANGE = 0.1


class Elasticity(StrEnum):
    """Whether elasticity reduces the force of a smooth sphere much (SOFT), or not (HARD).

    UNKNOWN: the effective modulus is not known.
    """

    HARD, SOFT, UNKNOWN = "hard", "soft", "unknown"


def assumed_modulus(hardness: float) -> float:
    """Return the effective modulus (Pa) to assume at a hardness (Pa); NaN below SOFT_HARDNESS."""
    return RUBY_ON_DIAMOND_MODULUS if hardness >= SOFT_HARDNESS else math.nan


def judge_tabor_parameter(contact: Contact, effective_modulus: float) -> Number:
    """Return the Tabor parameter, the range of adhesion as spacing; its status is `Elasticity`."""
    if math.isnan(effective_modulus):
        return Number("tabor_parameter", effective_modulus, status=Elasticity.UNKNOWN)
    value = float(tabor_parameter(contact.work, contact.radius, effective_modulus, contact.rho))
    softening = 1 - float(pull_off_coefficient(maugis_parameter(value))) / 2
    status = Elasticity.SOFT if softening > MAX_NEGLIGIBLE_CHANGE else Elasticity.HARD
    return Number("tabor_parameter", value, status=status)


def wide_contact_message(contact: Contact) -> str:
    """Return a message if the contact area alone attracts as strongly as a smooth sphere, or "".

    It names the largest preload (N) that is valid.
    """
    share = contact_term(contact)
    if share < 1:
        return ""
    return (
        f"preload: expected less than {format_quantity(contact.preload / share, 'N')} at this "
        f"hardness, radius and range, found {format_quantity(contact.preload, 'N')}: the contact "
        "alone would stick like a smooth sphere"
    )
