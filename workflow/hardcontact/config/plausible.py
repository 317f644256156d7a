"""The usual values of a contact's quantities; beyond them the unit may be wrong."""

from hardcontact.base.units import parse_quantity
from hardcontact.config.model import quantity_type
from hardcontact.contact.smooth_sphere import STRONGEST_WORK

#: The key of the configuration for each quantity of a contact.
QUANTITY_KEYS = {
    "radius": "sphere.radius",
    "hardness": "contact.hardness",
    "preload": "contact.preload",
    "range": "scales.range",
    "work": "adhesion.work",
}
#: The usual values of these quantities. Sources: spheres and loads of microscopes, lenses of the
#: surface forces apparatus: Butt et al., Surf. Sci. Rep. 59 (2005) 1; diamond: Brazhkin et al.,
#: Phil. Mag. A 82 (2002) 231; long ranges: DelRio et al., Nature Mater. 4 (2005) 629; works of
#: adhesion: Israelachvili, Intermolecular and Surface Forces (2011).
PLAUSIBLE_BOUNDS = {
    "radius": ("1 um", "50 mm", "spheres in pull-off tests, from colloidal probes to lenses"),
    "hardness": ("1 MPa", "150 GPa", "solids that yield, from soft plastics to diamond"),
    "preload": ("100 pN", "10 mN", "loads of microscopes and of microtesters"),
    "range": ("0.2 nm", "40 nm", "ranges from atomic bonds to long dispersion forces"),
    "work": ("0.1 mJ/m2", f"{STRONGEST_WORK:g} J/m2", "solids, up to diamond on itself"),
}


def unit_question(quantity: str, number: float) -> str:
    """Return a question if a number is not usual for a quantity of a contact, else no text.

    number: the value in the unit of the key.
    Returns the question, with the usual values.
    """
    low, high, kind = PLAUSIBLE_BOUNDS[quantity]
    unit = quantity_type(QUANTITY_KEYS[quantity]).unit
    if parse_quantity(low, unit) <= number <= parse_quantity(high, unit):
        return ""
    return f"is the unit right? {low} to {high} are usual for {kind}"
