"""The keys of a study: one model has their types, units, limits, defaults and documentation.

The defaults are the paper's. The string below a key says what it means; `key` names what a change
of it recomputes, and the section of the paper that the default comes from. The tables of
config/README.md are made from this module: ``python -m hardcontact.config.key_tables``.
Bounds are generous: what lies beyond has no physical meaning here, or no computer holds it.
"""

import os
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain, pairwise
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    GetCoreSchemaHandler,
    WrapValidator,
    model_validator,
)
from pydantic_core import CoreSchema, core_schema

from hardcontact.config.faults import Limit, refuse_lines, shortened, unmet, validated
from hardcontact.numbers.units import magnitude

#: Value of the key `published` in a study that is compared with the paper.
PAPER = "paper"
#: What stands for a table that the study does not have.
NONE = "none"
#: Value of the key `sphere.surface` of a sphere without roughness.
SMOOTH = "smooth"


@dataclass(frozen=True)
class Quantity:
    """Text such as "10 uN", which becomes a number in a unit of the study, between two bounds."""

    unit: str
    low: float
    high: float

    @property
    def expects(self) -> str:
        """What is accepted, in words."""
        return f"{self.low:g} to {self.high:g} {self.unit}"

    def number(self, text: object) -> float:
        """Return the number of a text, or raise a ValueError of what was expected and found."""
        value = magnitude(text, self.unit)
        if not self.low <= value <= self.high:
            raise ValueError(f"expected {self.expects}, found {shortened(text)}")
        return value

    def __get_pydantic_core_schema__(
        self, _type: Any, _handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Let pydantic take numbers from texts."""
        return core_schema.no_info_plain_validator_function(self.number)


@dataclass(frozen=True)
class Matching:
    """Printable text that matches a pattern as a whole, and what matches it, in words."""

    pattern: str
    expects: str

    def check(self, text: str) -> str:
        """Return a text that matches; raise a ValueError of what was expected and found."""
        # A terminal would obey what is not printable.
        if text.isprintable() and re.fullmatch(self.pattern, text):
            return text
        raise ValueError(f"expected {self.expects}, found {shortened(text)}")

    def __get_pydantic_core_schema__(self, _type: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Let pydantic check texts."""
        return core_schema.no_info_after_validator_function(self.check, handler(str))


def _ascending(texts: Any, validate: Callable[[Any], list[float]]) -> list[float]:
    """Refuse quantities that do not ascend, in whatever units they are written."""
    numbers = validate(texts)
    for place, (smaller, larger) in enumerate(pairwise(numbers)):
        if smaller >= larger:
            written = f"{texts[place + 1]} after {texts[place]}"
            raise ValueError(f"expected ascending values, found {written}")
    return numbers


def _once(entries: Any, validate: Callable[[Any], list[float]]) -> list[float]:
    """Refuse entries that are given twice."""
    values = validate(entries)
    if len(set(values)) < len(values):
        raise ValueError(f"expected each entry once, found {shortened(entries)}")
    return values


def _or_all(value: Any, validate: Callable[[Any], list[int]]) -> list[int] | str:
    """Accept the word all in place of a list."""
    if isinstance(value, str):
        if value != "all":
            raise ValueError(
                f"expected all, or a list of numbers of scans, found {shortened(value)}"
            )
        return value
    return validate(value)


def _of_six_digits(number: float) -> float:
    """Refuse a number that stands in names, of which two with more digits might be the same."""
    if float(f"{number:g}") != number:
        raise ValueError(f"expected at most six digits, found {number!r}")
    return number


ASCENDING, ONCE = WrapValidator(_ascending), WrapValidator(_once)

Length = Annotated[float, Quantity("nm", 0.01, 1e9)]
#: A range of adhesion: an atom is ten times larger than the least.
Range = Annotated[float, Quantity("nm", 0.01, 1000)]
Radius = Annotated[float, Quantity("nm", 10, 1e9)]
#: The radius of a tip; on finer pixels than its own a tip is dilated.
TipRadius = Annotated[float, Quantity("nm", 0.1, 1000)]
Force = Annotated[float, Quantity("N", 1e-12, 1)]
Pressure = Annotated[float, Quantity("Pa", 1e3, 1e13)]
Modulus = Annotated[float, Quantity("Pa", 5e10, 1e13)]
Work = Annotated[float, Quantity("J/m2", 1e-6, 100)]

Lengths = Annotated[list[Length], Field(min_length=1, max_length=100), ASCENDING]
Ranges = Annotated[list[Range], Field(min_length=1, max_length=100), ASCENDING]
Radii = Annotated[list[Radius], Field(min_length=1, max_length=20), ASCENDING]
TipRadii = Annotated[list[TipRadius], Field(max_length=20), ASCENDING]
#: Loads and hardnesses; robustness may have none.
Forces = Annotated[list[Force], Field(max_length=20), ASCENDING]
SomeForces = Annotated[list[Force], Field(min_length=1, max_length=20), ASCENDING]
Pressures = Annotated[list[Pressure], Field(max_length=20), ASCENDING]

#: Contacts along an edge: 40 000 a pair of scans.
Count = Annotated[int, Field(ge=1, le=200)]
Contacts = Annotated[int, Field(ge=1, le=40000)]
Realizations = Annotated[int, Field(ge=1, le=1000)]
ScanPixels = Annotated[int, Field(ge=16, le=8192)]
#: An odd grid has no order that its pixels halve; 16384 x 16384 pixels take 3.2 GiB.
Pixels = Annotated[int, Field(ge=32, le=16384, multiple_of=2)]
#: A smooth sphere on them, where the memory of the machine holds it (grids.py).
MasterPixels = Annotated[int, Field(ge=32, le=32768, multiple_of=2)]
Tiles = Annotated[int, Field(ge=1, le=256)]
PoissonRatio = Annotated[float, Field(ge=0, le=0.5, allow_inf_nan=False)]
Fraction = Annotated[float, Field(ge=0.001, le=0.999, allow_inf_nan=False)]

Skewness = Annotated[float, Field(ge=-1, le=1, allow_inf_nan=False), AfterValidator(_of_six_digits)]
Skewnesses = Annotated[list[Skewness], Field(max_length=20), ONCE]

SurfaceId = Annotated[
    str,
    Matching(
        "[a-z][a-z0-9_]*",
        "the id of a surface, lower-case letters, digits and underscores, a letter first",
    ),
]
ScanNumber = Annotated[int, Field(ge=1, le=9999)]
ScanNumbers = Annotated[
    list[ScanNumber], Field(min_length=1, max_length=9999), ONCE, WrapValidator(_or_all)
]
STUDY_NAME = Matching(
    "[A-Za-z0-9][A-Za-z0-9_.-]{0,99}",
    "a name of up to 100 letters, digits, dots, dashes and underscores",
)
StudyName = Annotated[str, STUDY_NAME]
Folder = Annotated[
    str,
    Matching(
        r"(?=.{1,200}$)/?(?!\.)[A-Za-z0-9_.-]+(/(?!\.)[A-Za-z0-9_.-]+)*",
        "a path of up to 200 letters, digits, dots, dashes and underscores, no name with a dot in "
        "front",
    ),
]
TablePath = Annotated[
    str, Matching("[^{}<>]{1,1000}", "the path of a table, without {, }, < and >")
]


def nm(*lengths: float) -> list[str]:
    """Return lengths in nm as they stand in a configuration."""
    return [f"{length:g} nm" for length in lengths]


def key(default: Any, recomputes: str, *, paper: str = "") -> Any:
    """Describe a key: its default, what a change of it recomputes, the section of the paper."""
    return Field(default=default, json_schema_extra={"recomputes": recomputes, "paper": paper})


class Keys(BaseModel):
    """Keys of the configuration: no others are accepted, and no value of another type."""

    model_config = ConfigDict(extra="forbid", strict=True, validate_default=True, frozen=True)


class SphereKeys(Keys):
    """The sphere."""

    surface: SurfaceId = key("ruby", "all forces", paper="Methods")
    """Surface of the table that is the sphere's; `smooth` for a sphere without roughness, with
    `published: none`."""
    radius: Radius = key(
        "250 um", "scans of the sphere, all forces", paper="Methods: diameter 0.5 mm"
    )
    """Radius; it is subtracted from the scans of the sphere."""


class ScanKeys(Keys):
    """Scans.

    Pixels and size of a measured scan are those of its file. Spectra are calibrated at the geometry
    that Table 1 was measured with (512 pixels, 2500 nm), whatever these keys say; scans of other
    pixels keep its rms heights.
    """

    pixels: ScanPixels = key(512, "substitute scans, all forces", paper="Methods")
    """Pixels along an edge of a substitute scan."""
    size: Length = key("2500 nm", "substitute scans, all forces", paper="Methods")
    """Edge of a substitute scan."""
    undefined_pixels: Literal["refuse", "harmonic"] = key(
        "refuse", "measured scans, their spectra and their forces"
    )
    """Measured scans with undefined pixels: `refuse` them, or fill the pixels with a `harmonic`
    function."""
    unit: Literal["none", "m", "mm", "um", "nm", "pm"] = key(
        "none", "measured scans, their spectra and their forces"
    )
    """Unit of length of all measured scans whose files state none; `none`: these are refused."""
    levelling: Literal["plane", "lines"] = key(
        "plane", "measured scans, their spectra and their forces"
    )
    """Of measured scans: subtract the mean `plane`, or align the `lines` of the scan first."""


class TopographyKeys(Keys):
    """Topography.

    Substitutes are calibrated to Table 1, and claims compared with it, under these definitions.
    """

    slope: Literal["gradient", "profile"] = key(
        "gradient", "substitute scans, all forces", paper="Table 1, not defined"
    )
    """What Table 1 calls rms slope: of the `gradient` (2D), or of the `profile` along x."""
    curvature: Literal["half_laplacian", "laplacian"] = key(
        "half_laplacian", "substitute scans, all forces", paper="Table 1, not defined"
    )
    """What Table 1 calls rms curvature."""


class ContactKeys(Keys):
    """Contact."""

    hardness: Pressure = key("25 GPa", "all forces", paper="Intrinsic Work of Adhesion")
    """Pressure on contact pixels, that of the softer body."""
    preload: Force = key(
        "10 uN", "all forces", paper="Numerical Analysis (`5 uN` is also printed, in Methods)"
    )
    """Load that the contact pixels carry."""
    window: Length = key("12500 nm", "all forces", paper="Intrinsic Work of Adhesion")
    """Edge of the square around a contact over which the force is summed."""
    count: Count = key(20, "all forces", paper="Intrinsic Work of Adhesion")
    """Contacts along an edge of the array, over one period of the stitched scan."""


class AdhesionKeys(Keys):
    """Adhesion.

    Forces are computed for a work of adhesion of 1 J/m², which only scales them. `contact.nc` uses
    the published range and work of adhesion (`resources/paper/parameters.csv`), and so do elastic
    contacts; `force.nc` of own surfaces uses `adhesion.work` and `scales.range`.
    """

    work: Work = key("46.3 mJ/m2", "`force.nc`", paper="Intrinsic Work of Adhesion")
    """With `published: none`: work of adhesion of the predicted force."""
    ranges: Ranges = key(
        nm(0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5, 5.6, 7, 8, 10, 14, 20, 28, 40),
        "forces of the scans",
        paper="Fig. 4",
    )
    """Ranges of adhesion ρ that forces are computed at, ascending; between them forces are
    interpolated."""


class InferenceKeys(Keys):
    """Inference."""

    samples: Annotated[int, Field(ge=20, le=10000)] = key(
        1000, "`inference.nc`, `band.nc`, `robustness.nc`, `classical.nc`; of own surfaces `fit.nc`"
    )
    """Random samples of means over scans, or realizations, that intervals follow from."""
    confidence: Fraction = key(
        0.95,
        "`topography.nc`, `inference.nc`, `band.nc`, `robustness.nc`, `classical.nc`; of own "
        "surfaces `edges.nc`, `force.nc`, `fit.nc`",
    )
    """Confidence of all intervals."""


class SmallScaleKeys(Keys):
    """Masters of small scales."""

    pixels: MasterPixels = key(
        8192, "small-scale masters", paper="Determining the Most Relevant Length-scales"
    )
    """Pixels along an edge of the small-scale master, whose edge is two scans."""
    transition: Length = key(
        "20 nm", "small-scale masters", paper="Determining the Most Relevant Length-scales"
    )
    """Wavelength below which roughness is artificial."""
    cutoffs: Lengths = key(
        nm(5, 10, 20, 30, 36, 43, 52, 62, 80, 120, 250, 500, 1000, 2500),
        "the forces of masters of this side, and `closed_form.nc`",
        paper="Fig. 6a",
    )
    """Short-wavelength cutoffs, ascending: all roughness below is removed."""


class LargeScaleKeys(Keys):
    """Masters of large scales."""

    pixels: Pixels = key(
        8192, "large-scale masters", paper="Determining the Most Relevant Length-scales"
    )
    """Pixels along an edge that forces are computed on at large scales."""
    tiles: Tiles = key(
        4, "large-scale masters", paper="Determining the Most Relevant Length-scales: 20 µm"
    )
    """Stitched scans along an edge of the large-scale master."""
    transition: Length = key(
        "1000 nm", "large-scale masters", paper="Determining the Most Relevant Length-scales"
    )
    """Wavelength above which roughness is artificial."""
    cutoffs: Lengths = key(
        nm(100, 250, 500, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3500, 5000, 10000),
        "the forces of masters of this side, and `closed_form.nc`",
        paper="Fig. 6b",
    )
    """Long-wavelength cutoffs, ascending: all roughness above is removed."""


class ScalesKeys(Keys):
    """Scales."""

    range: Range = key(
        "5.6 nm",
        "forces of the masters; how much a wider window changes the forces of the scans; these "
        "forces, unless the range is one of `adhesion.ranges`",
        paper="Determining the Most Relevant Length-scales",
    )
    """Range of adhesion of Fig. 6, and of the predicted force; always among those computed."""
    tolerance: Fraction = key(
        0.1,
        "`band.nc`, `robustness.nc`; of own surfaces `edges.nc`",
        paper="Determining the Most Relevant Length-scales",
    )
    """Relative change of the force that counts as none."""
    realizations: Realizations = key(5, "the masters added")
    """Masters of each substrate and side; realization k is built on scan k, from the first again
    when scans are used up."""
    sphere_roughness: bool = key(False, "forces of the masters", paper="not stated")
    """`true`: the sphere has the roughness of its first scan."""
    small: SmallScaleKeys = SmallScaleKeys()
    large: LargeScaleKeys = LargeScaleKeys()


class SphereMaterialKeys(Keys):
    """The material of the sphere."""

    modulus: Modulus = key("365 GPa", "elastic contacts", paper="Effective Work of Adhesion")
    """Young's modulus of the sphere."""
    poisson_ratio: PoissonRatio = key(0.29, "elastic contacts", paper="Effective Work of Adhesion")
    """Poisson's ratio of the sphere."""


class SubstrateMaterialKeys(Keys):
    """The material of the substrates."""

    modulus: Modulus = key("1010 GPa", "elastic contacts", paper="Effective Work of Adhesion")
    """Young's modulus of the substrates."""
    poisson_ratio: PoissonRatio = key(0.22, "elastic contacts", paper="Effective Work of Adhesion")
    """Poisson's ratio of the substrates."""


class ElasticKeys(Keys):
    """Elastic contact.

    Each scan of a substrate meets one scan of the sphere, in turn. A contact takes ten to twenty
    seconds to solve; all 400 of all scans take some 20 to 45 core hours. The report's figure shows
    medians over contacts, the claims take means.
    """

    sphere: SphereMaterialKeys = SphereMaterialKeys()
    substrate: SubstrateMaterialKeys = SubstrateMaterialKeys()
    contacts: Contacts = key(2, "elastic contacts")
    """Contacts solved on each scan, drawn at random; at most `contact.count` squared, which solves
    all."""


class IndentKeys(Keys):
    """Indents."""

    surface: SurfaceId = key("ncd", "`indent.nc`", paper="The Role of Plasticity")
    """Substrate whose contacts indent the sphere (Fig. 5a)."""
    preloads: SomeForces = key(
        ["10 uN", "20 uN"], "`indent.nc`", paper="The Role of Plasticity: `20 uN`"
    )
    """Loads, ascending; the contact drawn is that of median depth at the largest."""


class AsperitiesKeys(Keys):
    """Asperities."""

    contacts: Contacts = key(16, "asperities")
    """Contacts examined on each scan, drawn at random; at most `contact.count` squared."""
    ranges: Ranges = key(["1 nm", "2 nm", "5.6 nm", "10 nm"], "asperities")
    """Ranges of adhesion, ascending."""


class SetSmallScaleKeys(Keys):
    """Small-scale masters of the sets."""

    pixels: Pixels = key(4096, "forces of the small-scale masters of the sets and of robustness")
    """Pixels along an edge of the small-scale masters."""
    cutoffs: Lengths = key(
        nm(20, 30, 36, 43, 52, 62, 80, 120, 250),
        "forces of the small-scale masters of the sets and of robustness",
    )
    """Short-wavelength cutoffs, ascending; all of a master in one job."""


class SetLargeScaleKeys(Keys):
    """Large-scale masters of the sets."""

    pixels: Pixels = key(4096, "forces of the large-scale masters of the sets and of robustness")
    """Pixels along an edge that forces are computed on at large scales."""
    cutoffs: Lengths = key(
        nm(500, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3500),
        "forces of the large-scale masters of the sets and of robustness",
    )
    """Long-wavelength cutoffs, ascending; all of a master in one job."""


class SetsKeys(Keys):
    """Sets.

    Many equally good sets of substitute scans, drawn from a pool, in place of the one set of the
    study; each claim tells in how many sets it holds. Robustness is computed at the same size.
    """

    replicates: Annotated[int, Field(ge=1, le=10000)] = key(100, "`sets.nc`")
    """Sets drawn."""
    pool: Annotated[int, Field(ge=2, le=10000)] = key(60, "the scans added and their forces")
    """Independent scans of each substrate that sets are drawn from."""
    amplitudes: Annotated[int, Field(ge=4, le=50)] = key(7, "forces of the pool")
    """Heights that forces of each scan of the pool are computed at; between them forces are
    interpolated."""
    count: Count = key(10, "forces of the sets and of robustness")
    """Contacts along an edge of the array."""
    realizations: Realizations = key(20, "the masters added")
    """Masters of each substrate and side that bands are drawn from."""
    small: SetSmallScaleKeys = SetSmallScaleKeys()
    large: SetLargeScaleKeys = SetLargeScaleKeys()


class HeightsKeys(Keys):
    """Other distributions of heights."""

    surface: SurfaceId = key("polished_uncd", "the substitutes added and their forces")
    """Substrate whose substitutes get other heights."""
    skewness: Skewnesses = key([-1, -0.5, 0.5, 1], "the substitutes added and their forces")
    """Other skewness of its heights; one that it has already is not made again."""


class RobustnessKeys(Keys):
    """Robustness.

    The headline numbers under one other choice at a time, with the contacts, pixels and cutoffs of
    `sets` and one scan of the sphere, the first; the row "as the study" makes the study's own
    choices at this size. The other reading of `topography.curvature` and the other value of
    `scales.sphere_roughness` have a row without a key. Measured surfaces keep their scans in every
    row.
    """

    preloads: Forces = key(
        ["5 uN", "20 uN"],
        "forces of robustness",
        paper="`5 uN`: Methods; `20 uN`: The Role of Plasticity",
    )
    """Other preloads, ascending."""
    hardnesses: Pressures = key(["16 GPa", "47 GPa"], "forces of robustness")
    """Other hardnesses, ascending."""
    heights: HeightsKeys = HeightsKeys()
    tip_radii: TipRadii = key(["10 nm", "17 nm", "26 nm"], "the substitutes added and their forces")
    """Radii of tips that image the substitutes of the reference surface, ascending."""
    realizations: Realizations = key(3, "the masters added")
    """Masters of each substrate and side, the first of those of `sets`."""


class LawSmallScaleKeys(Keys):
    """Small-scale masters for other laws."""

    pixels: Pixels = key(2048, "forces of `laws.nc` and `scaling.nc`")
    """Pixels along an edge of the small-scale masters."""
    cutoffs: Lengths = key(["25 nm", "43 nm", "75 nm", "200 nm"], "forces of `laws.nc`")
    """Short-wavelength cutoffs, ascending."""


class LawLargeScaleKeys(Keys):
    """Large-scale masters for other laws."""

    pixels: Pixels = key(2048, "forces of `laws.nc`")
    """Pixels along an edge that forces are computed on at large scales."""
    tiles: Tiles = key(2, "forces of `laws.nc`")
    """Stitched scans along an edge of the large-scale master."""
    cutoffs: Lengths = key(["700 nm", "1300 nm", "2000 nm", "3500 nm"], "forces of `laws.nc`")
    """Long-wavelength cutoffs, ascending."""


class ScalingSmallScaleKeys(Keys):
    """Small-scale masters whose edges are scaled."""

    cutoffs: Lengths = key(nm(10, 20, 30, 43, 62, 90, 150, 300), "forces of `scaling.nc`")
    """Short-wavelength cutoffs, ascending."""


class ScalingLargeScaleKeys(Keys):
    """Large-scale masters whose edges are scaled."""

    pixels: Pixels = key(4096, "forces of `scaling.nc`")
    """Pixels along an edge that forces are computed on at large scales."""
    tiles: Tiles = key(4, "forces of `scaling.nc`")
    """Stitched scans along an edge of the large-scale master."""
    cutoffs: Lengths = key(
        nm(120, 250, 500, 800, 1200, 1800, 2700, 5000, 10000), "forces of `scaling.nc`"
    )
    """Long-wavelength cutoffs, ascending."""


class ScalingKeys(Keys):
    """Edges of the band over sphere, range and contact area."""

    radii: Radii = key(["5 um", "62.5 um", "250 um", "1000 um"], "forces of `scaling.nc`")
    """Radii of the spheres that edges of the band are found for, ascending."""
    ranges: Ranges = key(["1.4 nm", "5.6 nm", "11.2 nm"], "forces of `scaling.nc`")
    """Ranges of adhesion that edges are found for, ascending."""
    preloads: SomeForces = key(["1.25 uN", "10 uN", "80 uN"], "forces of `scaling.nc`")
    """Preloads that edges are found for, ascending; over the hardness they are the contact
    areas."""
    small: ScalingSmallScaleKeys = ScalingSmallScaleKeys()
    large: ScalingLargeScaleKeys = ScalingLargeScaleKeys()


class InsightKeys(Keys):
    """Insight.

    Beyond the paper: what decides the critical band, and how far the method can be trusted; the
    chapter that `snakemake insight` makes.
    """

    realizations: Realizations = key(
        3, "the random surfaces, and forces of the scans and masters added"
    )
    """Random surfaces of each size beside the closed form, scans with masters for other laws, of
    each substrate; surfaces in repeated contact."""
    count: Count = key(8, "forces of `closed_form.nc`, `laws.nc` and `scaling.nc`")
    """Contacts along an edge of the array."""
    ranges: Ranges = key(nm(0.5, 1, 2, 3.5, 5.6, 8, 14, 20), "`closed_form.nc`, `statistics.nc`")
    """Ranges of adhesion, ascending; `scales.range` is always one of them."""
    pixels: Pixels = key(1024, "`closed_form.nc`")
    """Pixels along an edge of the random surfaces beside the closed form."""
    sizes: Lengths = key(["5000 nm", "20000 nm"], "`closed_form.nc`, `repeated_contact.nc`")
    """Edges of these surfaces, ascending; repeated contact is on the largest."""
    reach: Length = key("80 um", "forces of `laws.nc`")
    """Edge of the window within which these laws attract, at least `contact.window`."""
    small: LawSmallScaleKeys = LawSmallScaleKeys()
    large: LawLargeScaleKeys = LawLargeScaleKeys()
    scaling: ScalingKeys = ScalingKeys()


class Study(Keys):
    """The study."""

    study: StudyName = key("paper", "nothing of the store")
    """Name; results go to `results/<study>/`."""
    store: Folder = key("results/store", "everything, in the new folder")
    """Folder of the intermediates, which studies may share."""
    surfaces: TablePath = key("config/surfaces.tsv", "what the changed rows concern")
    """Path of the table of surfaces."""
    scans: ScanNumbers = key("all", "the scans added, their pairs, and masters whose scan changes")
    """Numbers of the scans used, e.g. `[1, 2]`."""
    published: Literal["paper", "none"] = key("paper", "nothing of the store")
    """Published numbers that the study is compared with: those of the `paper`, or `none` in a study
    of own surfaces, which makes what its scans and forces allow and needs nothing of the paper."""
    forces: TablePath = key("none", "`fit.nc`")
    """With `published: none`: path of a table of pull-off forces measured on these surfaces, or
    `none`."""
    reference_surface: SurfaceId = key(
        "uncd", "`topography.nc`, `inference.nc`, `robustness.nc`", paper="Fig. 4b"
    )
    """With `published: paper`: substrate that ratios of forces are taken to."""
    seed: Annotated[int, Field(ge=0, le=4294967295)] = key(
        2021,
        "substitutes, masters, the choice of contacts for elastic contact and asperities, samples "
        "of means",
    )
    """Every random number follows from it and from the names of what it is for."""
    effort: Literal["full", "quick"] = key("full", "what the keys under `quick` say")
    """`quick`: the keys under `quick` replace those above, for a first answer."""
    quick: dict[Any, Any] = key({}, "what its keys say")
    """Keys as at the top, which count with `effort: quick`."""
    sphere: SphereKeys = SphereKeys()
    scan: ScanKeys = ScanKeys()
    topography: TopographyKeys = TopographyKeys()
    contact: ContactKeys = ContactKeys()
    adhesion: AdhesionKeys = AdhesionKeys()
    inference: InferenceKeys = InferenceKeys()
    scales: ScalesKeys = ScalesKeys()
    elastic: ElasticKeys = ElasticKeys()
    indent: IndentKeys = IndentKeys()
    asperities: AsperitiesKeys = AsperitiesKeys()
    sets: SetsKeys = SetsKeys()
    robustness: RobustnessKeys = RobustnessKeys()
    insight: InsightKeys = InsightKeys()

    @model_validator(mode="after")
    def _check_rules_across_keys(self) -> "Study":
        refuse_lines(unmet(chain(self._limits_of_names(), self._limits_of_published())))
        return self

    def _limits_of_names(self) -> Iterator[Limit]:
        """Yield the limits of the effort and of the folders."""
        quick = "quick (the quick study of the paper: --configfile config/quick.yaml)"
        filled = self.effort != "quick" or bool(self.quick)
        yield Limit(filled, "effort", "full where no keys stand under quick", quick)
        folder = f"results/{self.study}"
        results, store = Path(os.path.realpath(folder)), Path(os.path.realpath(self.store))
        apart = not (results.is_relative_to(store) or store.is_relative_to(results))
        yield Limit(apart, "store", f"a folder apart from {folder}", self.store)
        inside = store.is_relative_to(os.getcwd()) and not store.is_relative_to(results.parent)
        yield Limit(
            not inside, "store", "a folder in results or outside of the project", self.store
        )

    def _limits_of_published(self) -> Iterator[Limit]:
        """Yield the limits of a study that is compared with the paper, or of one that is not."""
        if self.published == PAPER:
            forces, contacts = self.forces, self.contact.count**2
            yield Limit(forces == NONE, "forces", f"{NONE} with published: {PAPER}", forces)
            expected = f"at most contact.count squared = {contacts}"
            for name in ("elastic", "asperities"):
                number = getattr(self, name).contacts
                yield Limit(number <= contacts, f"{name}.contacts", expected, number)
        elif self.sphere.surface == SMOOTH:
            expected = f"false with sphere.surface: {SMOOTH}"
            rough = self.scales.sphere_roughness
            yield Limit(not rough, "scales.sphere_roughness", expected, "true")


def section(name: str) -> type[Keys]:
    """Return the model of a section of keys, by its name with dots between its parts."""
    model: Any = Study
    for part in filter(None, name.split(".")):
        model = model.model_fields[part].annotation
    return model  # type: ignore[no-any-return]


def quantity(key: str) -> Quantity:
    """Return the unit and the bounds of a key that is a quantity."""
    above, _, name = key.rpartition(".")
    return next(
        part for part in section(above).model_fields[name].metadata if isinstance(part, Quantity)
    )


def configuration(config: object, where: str = "") -> dict[str, Any]:
    """Return a configuration, as read from YAML, with every quantity as a number.

    Lengths are in nm, forces in N, pressures in Pa, energies per area in J/m². Keys that are left
    out have their defaults. Raises ValueError with a line, after the text `where`, for each key
    that is unknown or of the wrong type, unit or size.
    """
    # `scans` may be a word in place of a list.
    return validated(Study, config, f"{where}config key ").model_dump(warnings=False)
