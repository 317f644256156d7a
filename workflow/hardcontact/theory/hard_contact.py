"""Whether bodies are hard enough, and the preload small enough, for the closed form."""

import math

from hardcontact.base.formatting import format_quantity
from hardcontact.base.number import Number
from hardcontact.contact.contact import Contact
from hardcontact.contact.smooth_sphere import (
    maugis_parameter,
    tabor_parameter,
    transition_coefficient,
)
from hardcontact.theory.closed_form import (
    contact_share,
)

#: Largest relative change of the force, by missing waves or by elasticity, that is negligible.
MAX_NEGLIGIBLE_CHANGE = 0.1
#: Statuses of the bodies of a contact.
HARD, SOFT, UNKNOWN = "hard", "soft", "unknown"


def tabor(contact: Contact, modulus: float) -> Number:
    """Return the Tabor parameter, with the range of adhesion as spacing, and its status.

    contact: the sphere and the attraction.
    modulus: effective modulus in Pa, NaN if it is not known.
    Returns the status is UNKNOWN without a modulus. It is SOFT if elasticity reduces the force of a
        smooth sphere by more than MAX_NEGLIGIBLE_CHANGE, otherwise HARD.
    """
    if math.isnan(modulus):
        return Number("tabor_parameter", modulus, status=UNKNOWN)
    value = float(tabor_parameter(contact.work, contact.radius, modulus, contact.range))
    softening = 1 - float(transition_coefficient(maugis_parameter(value))) / 2
    return Number(
        "tabor_parameter", value, status=SOFT if softening > MAX_NEGLIGIBLE_CHANGE else HARD
    )


def wide_contact_message(contact: Contact) -> str:
    """Return a message if the contact area alone attracts as strongly as a smooth sphere.

    The message is empty otherwise. It names the largest preload (N) that is valid.
    """
    share = contact_share(contact)
    if share < 1:
        return ""
    return (
        f"preload: expected less than {format_quantity(contact.preload / share, 'N')} at this "
        f"hardness, radius and range, found {format_quantity(contact.preload, 'N')}: the contact "
        "alone would stick like a smooth sphere"
    )
