"""The keys of a study: each field has the type, unit, limits, default and meaning of a key.

The defaults are the paper's. The string below a key gives its meaning; `key` names the section of
the paper that the default comes from. config/config.yaml is made from this module:
``python -m hardcontact.config.key_tables``.
"""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from hardcontact.config.key_types import (
    UNIT,
    ContactCount,
    Count,
    FilePath,
    Folder,
    Force,
    Forces,
    Fraction,
    Length,
    Lengths,
    Pixels,
    Pressure,
    Radii,
    Radius,
    Range,
    Ranges,
    Realizations,
    ScanPixels,
    StudyName,
    SurfaceId,
    TileCount,
    Work,
    or_word,
)


def nm(*lengths: float) -> list[str]:
    """Return lengths in nm as texts for a configuration."""
    return [f"{length:g} nm" for length in lengths]


def key(default: Any, paper: str = "") -> Any:
    """Describe a key: its default, and the section of the paper with this default."""
    return Field(default=default, json_schema_extra={"paper": paper})


class Keys(BaseModel):
    """Keys of the configuration: no others are accepted, and no value of another type."""

    model_config = ConfigDict(
        extra="forbid",
        strict=True,
        validate_default=True,
        frozen=True,
        use_attribute_docstrings=True,
    )


class SphereKeys(Keys):
    """The sphere that touches the surfaces."""

    surface: SurfaceId = key("ruby", "Methods")
    """Surface of the sphere; with `published: none` also `smooth`."""
    radius: Radius = key("250 um", "Methods (diameter 0.5 mm)")
    """Radius; a sphere of this radius is subtracted from scans of the sphere."""


class ScanKeys(Keys):
    """Size and features of substitute scans, and how files of measured scans are read."""

    pixels: ScanPixels = key(512, "Methods")
    """Pixels per row of a substitute scan."""
    size: Length = key("2500 nm", "Methods")
    """Width of a substitute scan."""
    featured_surface: SurfaceId = "polished_uncd"
    """Substrate whose substitutes have bumps or pits on a Gaussian base, or `none`."""
    undefined_pixels: Literal["refuse", "harmonic"] = "refuse"
    """`refuse` measured scans with undefined pixels, or fill these with a `harmonic` function."""
    unit: Annotated[str, UNIT] = "none"
    """Unit, or units of positions and heights, of files that state none; `none`: refuse them."""
    map_size: Annotated[Length, or_word("none")] = key("none")
    """Longer side of scans whose files state no size; `none`: refuse them."""
    mask: Literal["keep", "exclude"] = "keep"
    """Pixels under a mask of Gwyddion: `keep` their heights, or `exclude` them as undefined."""
    levelling: Literal["plane", "lines", "quadratic"] = "plane"
    """Removed from scans: a `plane`, also streaks and offsets of `lines`, or a `quadratic` form."""


class ContactKeys(Keys):
    """One contact, and the array of contacts on a scan."""

    hardness: Pressure = key("25 GPa", "Intrinsic Work of Adhesion")
    """Hardness of the softer body: the pressure on contact pixels."""
    preload: Force = key("10 uN", "Numerical Analysis; Methods has `5 uN`")
    """Load that the contact pixels carry."""
    window: Length = key("12500 nm", "Intrinsic Work of Adhesion")
    """Width of the square around a contact over which the force is summed."""
    contacts_per_row: Count = key(20, "Intrinsic Work of Adhesion")
    """Contacts per row of a square array over one period of the stitched scan."""


class AdhesionKeys(Keys):
    """Work and range of adhesion."""

    work: Work = key("46.3 mJ/m2", "Intrinsic Work of Adhesion")
    """With `published: none`: work of adhesion of the predicted force."""
    range: Range = key("5.6 nm", "Most Relevant Length-scales")
    """Range of adhesion at which the band is found and the force predicted."""
    ranges: Ranges = key(
        nm(0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5, 5.6, 7, 8, 10, 14, 20, 28, 40),
        "Fig. 4, and beyond on both sides",
    )
    """Ranges of adhesion ρ at which forces are computed; between them forces are interpolated."""


class InferenceKeys(Keys):
    """Intervals of means."""

    samples: Annotated[int, Field(ge=20, le=10000)] = 1000
    """Random samples of each mean over scans or realizations, from which its interval follows."""
    confidence: Fraction = 0.95
    """Confidence of all intervals."""


class ShortSideKeys(Keys):
    """Masters with artificial roughness at short wavelengths."""

    pixels: Pixels = key(8192, "Most Relevant Length-scales")
    """Pixels per row of the short-edge master, which is as wide as two scans."""
    transition: Length = key("20 nm", "Most Relevant Length-scales")
    """Wavelength below which roughness is artificial."""
    cutoffs: Lengths = key(
        nm(5, 10, 20, 30, 36, 43, 52, 62, 80, 120, 250, 500, 1000, 2500), "Fig. 6a"
    )
    """Short-wavelength cutoffs: all roughness below is removed."""


class LongSideKeys(Keys):
    """Masters with artificial roughness at long wavelengths."""

    pixels: Pixels = key(8192, "Most Relevant Length-scales")
    """Pixels per row of the long-edge master, on which the force is summed."""
    tiles: TileCount = key(4, "Most Relevant Length-scales (20 µm)")
    """Stitched scans per row of the long-edge master."""
    transition: Length = key("1000 nm", "Most Relevant Length-scales")
    """Wavelength above which roughness is artificial."""
    cutoffs: Lengths = key(
        nm(100, 250, 500, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3500, 5000, 10000),
        "Fig. 6b",
    )
    """Long-wavelength cutoffs: all roughness above is removed."""


class ScalesKeys(Keys):
    """Masters, and cutoffs at which they are filtered, for the edges of the band."""

    tolerance: Fraction = key(0.1, "Most Relevant Length-scales")
    """Relative change up to which a force counts as unchanged."""
    realizations: Realizations = 5
    """Masters of each substrate for each edge of the band, built on its scans in turn."""
    whole_surfaces: Realizations = 10
    """Random surfaces per substrate, as wide as long-edge masters, neither mirrored nor tiled: for
    octaves, the band alone, and the posterior."""
    sphere_roughness: bool = key(False, "not stated")
    """Paper's study: give the sphere the roughness of its first scan in the cutoff computations. (A
    scanned sphere of your own is always rough.)"""
    short: ShortSideKeys = ShortSideKeys()
    long: LongSideKeys = LongSideKeys()


class ElasticKeys(Keys):
    """Elastic contact, on a sample of the contacts."""

    contacts: ContactCount = 2
    """Contacts solved on each scan, chosen at random."""


class IndentKeys(Keys):
    """Indents that contacts leave in the sphere."""

    surface: SurfaceId = key("ncd", "The Role of Plasticity")
    """Substrate whose contacts indent the sphere."""
    preloads: Forces = key(["10 uN", "20 uN"], "The Role of Plasticity (`20 uN`)")
    """Loads; the figure shows the contact of median depth at the largest."""


class AsperitiesKeys(Keys):
    """Asperities that carry the force, on a sample of the contacts."""

    contacts: ContactCount = 16
    """Contacts examined on each scan, chosen at random."""
    ranges: Ranges = key(["1 nm", "2 nm", "5.6 nm", "10 nm"])
    """Ranges of adhesion."""


class SetShortSideKeys(Keys):
    """Short-edge masters of the sets."""

    pixels: Pixels = 4096
    """Pixels per row of the short-edge masters."""
    cutoffs: Lengths = key(nm(20, 30, 36, 43, 52, 62, 80, 120, 250))
    """Short-wavelength cutoffs."""


class SetLongSideKeys(Keys):
    """Long-edge masters of the sets."""

    pixels: Pixels = 4096
    """Pixels per row of the long-edge masters."""
    cutoffs: Lengths = key(nm(500, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3500))
    """Long-wavelength cutoffs."""


class SetsKeys(Keys):
    """Sets of substitute scans, from whose scatter intervals follow."""

    count: Annotated[int, Field(ge=1, le=10000)] = 100
    """Number of sets of scans, all with the same mean and ± of the rms height."""
    pool_size: Annotated[int, Field(ge=2, le=10000)] = 60
    """Scans of each substrate from which sets are sampled."""
    rms_height_count: Annotated[int, Field(ge=4, le=50)] = 7
    """Rms heights at which forces on the pool are computed; forces between are interpolated."""
    contacts_per_row: Count = 10
    """Contacts per row of the array."""
    realizations: Realizations = 20
    """Masters of each substrate for each edge, from which the bands of sets are sampled."""
    short: SetShortSideKeys = SetShortSideKeys()
    long: SetLongSideKeys = SetLongSideKeys()


class ExponentKeys(Keys):
    """Exponents of the force and of the short edge with radius and load."""

    realizations: Realizations = 3
    """Masters of the sets for each edge from which exponents and `edge_shifts.nc` follow."""
    radii: Radii = key(["5 um", "62.5 um", "250 um", "1000 um"])
    """Radii of the spheres."""


class StudyKeys(Keys):
    """All keys of a study."""

    study: StudyName = "paper"
    """Name; results go to `results/<study>/`."""
    store: Folder = "results/store"
    """Folder of the intermediates, which studies may share."""
    surfaces: FilePath = "config/surfaces.tsv"
    """Path of the table of surfaces."""
    scans: Annotated[list[int], Field(min_length=1), or_word("all")] = key("all")
    """Numbers of the scans used, such as `[1, 2]`, or `all`."""
    published: Literal["paper", "none"] = "paper"
    """Publication that the study is compared with: the `paper`, or `none` for your surfaces."""
    forces: FilePath = "none"
    """With `published: none`: table of forces measured on these surfaces, or `none`."""
    given: list[Literal["radius", "hardness", "preload", "range", "work"]] = []
    """With `published: none`: quantities you know; others equal to the paper's are assumed."""
    reference_surface: SurfaceId = key("uncd", "Fig. 4b")
    """Substrate whose force is the denominator of ratios of forces."""
    seed: Annotated[int, Field(ge=0, le=4294967295)] = 2021
    """Seed of all random numbers."""
    effort: Literal["full", "quick"] = "full"
    """`quick`: values under the key `quick` apply, for a first answer."""
    quick: dict[Any, Any] = {}
    """Keys for `effort: quick`, which makes a study and a store whose names end with `-quick`."""
    sphere: SphereKeys = SphereKeys()
    scan: ScanKeys = ScanKeys()
    contact: ContactKeys = ContactKeys()
    adhesion: AdhesionKeys = AdhesionKeys()
    inference: InferenceKeys = InferenceKeys()
    scales: ScalesKeys = ScalesKeys()
    elastic: ElasticKeys = ElasticKeys()
    indent: IndentKeys = IndentKeys()
    asperities: AsperitiesKeys = AsperitiesKeys()
    sets: SetsKeys = SetsKeys()
    exponents: ExponentKeys = ExponentKeys()
