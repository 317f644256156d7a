"""The inputs of contacts, and the names of contact models and of the axes of arrays of contacts."""

import math
from dataclasses import dataclass

#: Contact models: the contact pixels yield, or a single pixel touches.
PLASTIC = "plastic"
RIGID = "rigid"
#: Contact models by increasing area.
CONTACT_MODELS = [RIGID, PLASTIC]
#: Axes of the array of contacts.
CONTACT_AXES = ("contact_y", "contact_x")
#: Dimensions of the contacts on one scan. `sphere_scan` numbers the scans of the sphere, or
#: positions on one of them. `contact` numbers contacts that were selected from the array.
CONTACT_DIMENSIONS = ("sphere_scan", "contact", *CONTACT_AXES)


@dataclass(frozen=True, kw_only=True)
class Contact:
    """Sphere, loading (preload, hardness, `plastic`), adhesion and array of contacts."""

    radius: float  #: Radius of the sphere in nm.
    preload: float  #: Load in N.
    hardness: float  #: Hardness of the softer body in Pa.
    plastic: bool = True  #: Whether contact pixels yield; else a single pixel touches.
    #: Width in nm of the square around each contact that attracts; forces on maps need it.
    window: float = math.nan
    contacts_per_row: int = 1  #: Number of contacts in each row of the square array.
    rho: float = math.nan  #: Range of adhesion in nm.
    work: float = math.nan  #: Work of adhesion in J/m²; most forces are computed at 1 J/m².

    @property
    def loading_name(self) -> str:
        """The loading as a part of paths: ``"H25GPa-F10uN"``, ``"rigid-F10uN"``."""
        hardness = f"H{self.hardness / 1e9:.12g}GPa" if self.plastic else RIGID
        return f"{hardness}-F{self.preload * 1e6:.12g}uN"

    @property
    def area(self) -> float:
        """The contact area, preload over hardness, in nm²; zero in rigid contact."""
        return self.preload / self.hardness * 1e18 if self.plastic else 0.0

    def pixel_count(self, pixel_size: float) -> int:
        """Return the least number of pixels of a size (nm) that carry the preload, at least 1."""
        # The factor below one keeps rounding errors from adding a pixel.
        return max(1, math.ceil(self.area / pixel_size**2 * (1 - 1e-12)))
