"""The keys of a study, one field a key: type, unit, limits, default and documentation.

The defaults are the paper's. The string below a key gives its meaning; `key` names the section of
the paper that the default comes from. config/config.yaml and the tables of config/README.md are
made from this module: ``python -m hardcontact.config.key_tables``.
"""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from hardcontact.config.key_types import (
    UNIT,
    ContactCount,
    Count,
    Folder,
    Force,
    Forces,
    Fraction,
    Length,
    LengthOrNone,
    Lengths,
    MasterPixels,
    Pixels,
    Pressure,
    Radii,
    Radius,
    Range,
    Ranges,
    Realizations,
    ScanNumbers,
    ScanPixels,
    StudyName,
    SurfaceId,
    TablePath,
    TileCount,
    Work,
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
    """The sphere."""

    surface: SurfaceId = key("ruby", "Methods")
    """Surface (its id in the table) that is the roughness of the sphere; `smooth` for a sphere
    without roughness, with `published: none`."""
    radius: Radius = key("250 um", "Methods: diameter 0.5 mm")
    """Radius; it is subtracted from the scans of the sphere."""


class ScanKeys(Keys):
    """Scans.

    A measured scan has the pixels and the size of its file. Spectra are calibrated at the geometry
    of the scans of Table 1 (512 pixels, 2500 nm), regardless of these keys. Scans with other pixels
    keep the rms heights of Table 1.
    """

    pixels: ScanPixels = key(512, "Methods")
    """Pixels along a side of a substitute scan."""
    size: Length = key("2500 nm", "Methods")
    """Side of a substitute scan."""
    featured_surface: SurfaceId = "polished_uncd"
    """Substrate whose substitute scans have features, bumps or pits, on a Gaussian base; `none`: no
    substrate."""
    undefined_pixels: Literal["refuse", "harmonic"] = "refuse"
    """Measured scans with undefined pixels: `refuse` them, or fill the pixels with a `harmonic`
    function."""
    unit: Annotated[str, UNIT] = "none"
    """Unit of length of all measured scans whose files state none; two, such as `mm,nm`, for
    positions and for heights; `none`: such files are refused."""
    map_size: LengthOrNone = key("none")
    """The longer side of all measured scans whose files state no size; `none`: such files are
    refused."""
    levelling: Literal["plane", "lines", "quadratic"] = "plane"
    """For measured scans: subtract the mean `plane`, align the `lines` of the scan first, or
    subtract a `quadratic` polynomial (the bow of a scanner)."""


class ContactKeys(Keys):
    """Contact."""

    hardness: Pressure = key("25 GPa", "Intrinsic Work of Adhesion")
    """Pressure on contact pixels, that of the softer body: ruby."""
    preload: Force = key("10 uN", "Numerical Analysis (`5 uN` is also printed, in Methods)")
    """Load that the contact pixels carry."""
    window: Length = key("12500 nm", "Intrinsic Work of Adhesion")
    """Side of the square around a contact over which the force is summed."""
    count: Count = key(20, "Intrinsic Work of Adhesion")
    """Contacts along a side of the array, over one period of the stitched scan."""


class AdhesionKeys(Keys):
    """Adhesion.

    Forces are computed for a work of adhesion of 1 J/m², which only scales them. `contact.nc` uses
    the published range and work of adhesion (`resources/paper/parameters.csv`), and so do elastic
    contacts; `force.nc` of own surfaces uses `adhesion.work` and `scales.range`.
    """

    work: Work = key("46.3 mJ/m2", "Intrinsic Work of Adhesion")
    """With `published: none`: work of adhesion of the predicted force."""
    ranges: Ranges = key(
        nm(0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5, 5.6, 7, 8, 10, 14, 20, 28, 40),
        "Fig. 4, and beyond on both sides",
    )
    """Ranges of adhesion ρ at which forces are computed, ascending; between them forces are
    interpolated."""


class InferenceKeys(Keys):
    """Inference."""

    samples: Annotated[int, Field(ge=20, le=10000)] = 1000
    """Random samples of each mean over scans or realizations, from which intervals are computed."""
    confidence: Fraction = 0.95
    """Confidence of all intervals."""


class SmallScaleKeys(Keys):
    """Masters of small scales."""

    pixels: MasterPixels = key(8192, "Determining the Most Relevant Length-scales")
    """Pixels along a side of the small-scale master, which is two scans long: 0.610 nm per pixel
    (0.625 nm in the paper)."""
    transition: Length = key("20 nm", "Determining the Most Relevant Length-scales")
    """Wavelength below which roughness is artificial."""
    cutoffs: Lengths = key(
        nm(5, 10, 20, 30, 36, 43, 52, 62, 80, 120, 250, 500, 1000, 2500), "Fig. 6a"
    )
    """Short-wavelength cutoffs, ascending: all roughness below is removed."""


class LargeScaleKeys(Keys):
    """Masters of large scales."""

    pixels: Pixels = key(8192, "Determining the Most Relevant Length-scales")
    """Pixels along a side of the grid on which forces on large-scale masters are computed."""
    tiles: TileCount = key(4, "Determining the Most Relevant Length-scales: 20 µm")
    """Stitched scans along a side of the large-scale master; 4 have the printed 20 µm. (8 would
    have 8192 pixels of the printed 4.883 nm, but 40 µm.)"""
    transition: Length = key("1000 nm", "Determining the Most Relevant Length-scales")
    """Wavelength above which roughness is artificial."""
    cutoffs: Lengths = key(
        nm(100, 250, 500, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3500, 5000, 10000),
        "Fig. 6b",
    )
    """Long-wavelength cutoffs, ascending: all roughness above is removed."""


class ScalesKeys(Keys):
    """Scales.

    More realizations add masters; existing masters stay.
    """

    range: Range = key("5.6 nm", "Determining the Most Relevant Length-scales")
    """Range of adhesion of Fig. 6, and of the predicted force; always among those computed."""
    tolerance: Fraction = key(0.1, "Determining the Most Relevant Length-scales")
    """Relative change of the force up to which the force counts as unchanged."""
    realizations: Realizations = 5
    """Masters of each substrate on each side of the band. Realization k is built on scan k; after
    the last scan the first follows again."""
    whole_surfaces: Realizations = 10
    """Surfaces of each substitute as large as a large-scale master and not mirrored, on which
    octaves are amplified and the band is isolated."""
    sphere_roughness: bool = key(False, "not stated")
    """`true`: the sphere has the roughness of its first scan."""
    small: SmallScaleKeys = SmallScaleKeys()
    large: LargeScaleKeys = LargeScaleKeys()


class ElasticKeys(Keys):
    """Elastic contact.

    Each scan of a substrate meets one scan of the sphere, in turn. A contact takes about a second.
    The report's figure shows medians over contacts, the claims take means.
    """

    contacts: ContactCount = 2
    """Contacts solved on each scan, sampled at random; at most `contact.count` squared, all
    contacts."""


class IndentKeys(Keys):
    """Indents."""

    surface: SurfaceId = key("ncd", "The Role of Plasticity")
    """Substrate whose contacts indent the sphere (Fig. 5a)."""
    preloads: Forces = key(["10 uN", "20 uN"], "The Role of Plasticity: `20 uN`")
    """Loads, ascending; figures show the contact of median depth at the largest load."""


class AsperitiesKeys(Keys):
    """Asperities."""

    contacts: ContactCount = 16
    """Contacts examined on each scan, sampled at random; at most `contact.count` squared."""
    ranges: Ranges = key(["1 nm", "2 nm", "5.6 nm", "10 nm"])
    """Ranges of adhesion, ascending."""


class SetSmallScaleKeys(Keys):
    """Small-scale masters of the sets."""

    pixels: Pixels = 4096
    """Pixels along a side of the small-scale masters."""
    cutoffs: Lengths = key(nm(20, 30, 36, 43, 52, 62, 80, 120, 250))
    """Short-wavelength cutoffs, ascending."""


class SetLargeScaleKeys(Keys):
    """Large-scale masters of the sets."""

    pixels: Pixels = 4096
    """Pixels along a side of the grid on which forces on large-scale masters are computed."""
    cutoffs: Lengths = key(nm(500, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3500))
    """Long-wavelength cutoffs, ascending."""


class SetsKeys(Keys):
    """Sets.

    Each set is as good as the substitute scans of the study. Sets are sampled from a pool. Each
    claim reports the share of sets in which it holds. A larger `pool` and more realizations add
    scans and masters; existing ones stay.
    """

    replicates: Annotated[int, Field(ge=1, le=10000)] = 100
    """Number of sets."""
    pool: Annotated[int, Field(ge=2, le=10000)] = 60
    """Number of independent scans of each substrate from which sets are sampled."""
    rms_heights: Annotated[int, Field(ge=4, le=50)] = 7
    """Number of rms heights at which the forces of each scan of the pool are computed; between
    them forces are interpolated."""
    count: Count = 10
    """Contacts along a side of the array."""
    realizations: Realizations = 20
    """Masters of each substrate on each side, from which bands are sampled."""
    small: SetSmallScaleKeys = SetSmallScaleKeys()
    large: SetLargeScaleKeys = SetLargeScaleKeys()


class ScalingKeys(Keys):
    """Scaling.

    `scaling.nc` has exponents of the force and of the short edge: with the radius of the sphere and
    with the load, which is the preload or an eighth of it. Its masters are the first of the sets.
    """

    realizations: Realizations = 3
    """Masters of each substrate on each side; those of `enhancement.nc` are as many."""
    radii: Radii = key(["5 um", "62.5 um", "250 um", "1000 um"])
    """Radii of the spheres, ascending."""


class StudyKeys(Keys):
    """The study.

    Studies with different names share the intermediates in the store; a new store starts empty.
    """

    study: StudyName = "paper"
    """Name; results go to `results/<study>/`."""
    store: Folder = "results/store"
    """Folder of the intermediates, which studies may share."""
    surfaces: TablePath = "config/surfaces.tsv"
    """Path of the table of surfaces."""
    scans: ScanNumbers = key("all")
    """Numbers of the scans used, e.g. `[1, 2]`."""
    published: Literal["paper", "none"] = "paper"
    """Published numbers that the study is compared with: those of the `paper`, or `none` for own
    surfaces. Such a study makes what its scans and forces allow."""
    forces: TablePath = "none"
    """With `published: none`: path of a table of pull-off forces measured on these surfaces, or
    `none`."""
    reference_surface: SurfaceId = key("uncd", "Fig. 4b")
    """With `published: paper`: substrate in the denominator of ratios of forces."""
    seed: Annotated[int, Field(ge=0, le=4294967295)] = 2021
    """Seed of all random numbers. Each also depends on its purpose, such as surface and scan."""
    effort: Literal["full", "quick"] = "full"
    """`quick`: the keys under `quick` replace those above, for a first answer."""
    quick: dict[Any, Any] = {}
    """Keys as at the top, used with `effort: quick`. The names of `study` and `store` then end with
    `-quick`."""
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
    scaling: ScalingKeys = ScalingKeys()
