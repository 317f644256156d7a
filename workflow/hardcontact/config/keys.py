"""The keys of a study, with types, meanings, the defaults of the paper, and rules across keys.

``python -m hardcontact.config.key_tables`` makes config/config.yaml from them.
"""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from hardcontact.config import key_types as types
from hardcontact.config.faults import key_fault, raise_faults

#: Value of the key `published` in a study that is compared with the paper.
PAPER = "paper"
#: Value of keys that name nothing: `forces` without a table, `published` without the paper.
NONE = "none"
#: Value of the key `sphere.surface` of a sphere without roughness.
SMOOTH_SPHERE = "smooth"
#: End of the names of study and store at quick effort.
QUICK_SUFFIX = "-quick"


def nm(*lengths: float) -> list[str]:
    """Return lengths in nm as texts for a configuration."""
    return [f"{length:g} nm" for length in lengths]


def key(default: Any, paper_section: str = "") -> Any:
    """Describe a key: its default, and the section of the paper with this default."""
    return Field(default=default, json_schema_extra={"paper": paper_section})


class Keys(BaseModel):
    """Keys of a section, or cells of a row: by default other names and types are refused."""

    model_config = ConfigDict(
        extra="forbid",
        strict=True,
        validate_default=True,
        frozen=True,
        use_attribute_docstrings=True,
    )


class SphereKeys(Keys):
    """The sphere that touches the surfaces."""

    surface: types.SurfaceId = key("ruby", "Methods")
    """Surface of the sphere. With `published: none` also `smooth`: a sphere without roughness."""
    radius: types.Radius = key("250 um", "Methods (diameter 0.5 mm)")
    """Radius of the sphere. A sphere of this radius is subtracted from its scans."""


class ScanKeys(Keys):
    """How measured scans are read and levelled."""

    undefined_pixels: Literal["refuse", "harmonic"] = "refuse"
    """`refuse` measured scans with undefined pixels, or fill the gaps with a `harmonic` function,
    which is smoother than the surface."""
    unit: Annotated[str, types.UNIT] = "none"
    """Unit of length for files that state none, or two: of positions and of heights. With `none`
    such files are refused."""
    map_size: Annotated[types.Length, types.or_word("none")] = key("none")
    """Longer side of the scan for files that state no size. With `none` such files are refused."""
    mask: Literal["keep", "exclude"] = "keep"
    """`keep` the heights under a mask of Gwyddion, or `exclude` them as undefined."""
    levelling: Literal["plane", "lines", "quadratic"] = "plane"
    """Levelling subtracts a `plane`; with `lines` also streaks and offsets of lines; with
    `quadratic` also the bow of a scanner. The last two remove some real roughness, too."""


class SubstituteKeys(Keys):
    """Substitutes: random scans in place of scans that are not available."""

    pixels: Annotated[int, Field(ge=16, le=8192)] = key(512, "Methods")
    """Pixels per row of a substitute. More pixels resolve shorter wavelengths and cost time."""
    size: types.Length = key("2500 nm", "Methods")
    """Width of a substitute. A wider substitute has longer wavelengths and larger pixels."""
    featured_surface: types.SurfaceId = "polished_uncd"
    """Substrate whose substitutes have bumps or pits on a Gaussian base, or `none`. Their rms
    heights then scatter as much as the published ones."""


class ContactKeys(Keys):
    """One contact of the sphere, and the square array of contacts on a scan."""

    hardness: types.Pressure = key("25 GPa", "Intrinsic Work of Adhesion")
    """Hardness of the softer body: the pressure on contact pixels. On harder bodies fewer pixels
    touch, and the force is smaller."""
    preload: types.Force = key("10 uN", "Numerical Analysis; Methods has `5 uN`")
    """Load that contact pixels carry before pull-off. Under a larger load more pixels touch, and
    the force is larger."""
    window: types.Length = key("12500 nm", "Intrinsic Work of Adhesion")
    """Width of the square around a contact over which the force is summed. A wider window holds
    more of the attraction and costs time."""
    contacts_per_row: types.ContactsPerRow = key(20, "Intrinsic Work of Adhesion")
    """Contacts per row of the array over a mirrored scan. With more contacts the mean force
    scatters less and costs more time."""


class AdhesionKeys(Keys):
    """Work and range of adhesion."""

    work: types.Work = key("46.3 mJ/m2", "Intrinsic Work of Adhesion")
    """With `published: none`: work of adhesion. The predicted force is proportional to it."""
    range: types.Range = key("5.6 nm", "Most Relevant Length-scales")
    """Range of adhesion ρ for which the force is predicted and the band found. A longer range
    bridges higher roughness, and the force is larger."""
    ranges: types.Ranges = key(
        nm(0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5, 5.6, 7, 8, 10, 14, 20, 28, 40),
        "Fig. 4, and beyond on both sides",
    )
    """Ranges of adhesion ρ at which forces are computed; between them forces are interpolated."""


class IntervalKeys(Keys):
    """Number of random samples behind each interval, and confidence of the intervals."""

    samples: Annotated[int, Field(ge=20, le=10000)] = 1000
    """Random samples of scans or masters for each interval. With more samples the ends of intervals
    scatter less."""
    confidence: types.Fraction = 0.95
    """Confidence of all intervals. Larger values widen them."""


class ShortSideKeys(Keys):
    """Masters for the short edge of the band: roughness at short wavelengths is artificial."""

    pixels: types.Pixels = key(8192, "Most Relevant Length-scales")
    """Pixels per row of a short-edge master, which is two scans wide. More pixels hold shorter
    wavelengths and cost time."""
    transition: types.Length = key("20 nm", "Most Relevant Length-scales")
    """Wavelength below which roughness is artificial."""
    cutoffs: types.Lengths = key(
        nm(5, 10, 20, 30, 36, 43, 52, 62, 80, 120, 250, 500, 1000, 2500), "Fig. 6a"
    )
    """Cutoffs: at each, all roughness at shorter wavelengths is removed, and the force computed."""


class LongSideKeys(Keys):
    """Masters for the long edge of the band: roughness at long wavelengths is artificial."""

    pixels: types.Pixels = key(8192, "Most Relevant Length-scales")
    """Pixels per row of a long-edge master when its force is computed: at least those of its
    scans."""
    tiles: Annotated[int, Field(ge=1, le=256)] = key(4, "Most Relevant Length-scales (20 µm)")
    """Mirrored scans per row of a long-edge master. More tiles hold longer wavelengths."""
    transition: types.Length = key("1000 nm", "Most Relevant Length-scales")
    """Wavelength above which roughness is artificial."""
    cutoffs: types.Lengths = key(
        nm(100, 250, 500, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3000, 3500, 5000, 10000),
        "Fig. 6b",
    )
    """Cutoffs: at each, all roughness at longer wavelengths is removed, and the force computed."""


class BandKeys(Keys):
    """The band of wavelengths that decide the force, found on masters: partly artificial scans."""

    tolerance: types.Fraction = key(0.1, "Most Relevant Length-scales")
    """Relative change up to which a force counts as unchanged. Larger values narrow the band."""
    masters: types.MasterCount = 5
    """Masters of each substrate for each edge of the band. With more masters edges scatter less and
    cost more time."""
    whole_surfaces: Annotated[int, Field(ge=1, le=1000)] = 10
    """Periodic random surfaces of each substrate, as wide as long-edge masters. On them forces are
    computed for the changes by octave, the band alone, and the posterior."""
    sphere_roughness: bool = key(False, "not stated")
    """Paper's study: whether the sphere has the roughness of its first scan when the band is
    computed. With `published: none` a scanned sphere is always rough."""
    short: ShortSideKeys = ShortSideKeys()
    long: LongSideKeys = LongSideKeys()


class ElasticKeys(Keys):
    """Elastic contact, solved for a sample of the contacts."""

    contacts: types.ContactCount = 2
    """Contacts solved on each scan, chosen at random. Each costs time."""


class IndentKeys(Keys):
    """Indents that contacts leave in the sphere."""

    surface: types.SurfaceId = key("ncd", "The Role of Plasticity")
    """Substrate whose contacts indent the sphere."""
    preloads: types.Forces = key(["10 uN", "20 uN"], "The Role of Plasticity (`20 uN`)")
    """Loads. Larger loads make deeper indents. Fig. 5 shows the contact of median depth at the
    largest load."""


class AsperitiesKeys(Keys):
    """Asperities that carry the force, on a sample of the contacts."""

    contacts: types.ContactCount = 16
    """Contacts examined on each scan, chosen at random. Each costs time."""
    ranges: types.Ranges = key(["1 nm", "2 nm", "5.6 nm", "10 nm"])
    """Ranges of adhesion ρ."""


class SetShortSideKeys(Keys):
    """Short-edge masters of the sets; other keys are those of `band.short`."""

    pixels: types.Pixels = 4096
    """Pixels per row of a master."""
    cutoffs: types.Lengths = key(nm(5, 10, 20, 30, 36, 43, 52, 62, 80, 120, 250))
    """Cutoffs: at each, all roughness at shorter wavelengths is removed."""


class SetLongSideKeys(Keys):
    """Long-edge masters of the sets; other keys are those of `band.long`."""

    pixels: types.Pixels = 4096
    """Pixels per row of a master."""
    cutoffs: types.Lengths = key(nm(500, 800, 1100, 1400, 1600, 1800, 2000, 2300, 2700, 3000, 3500))
    """Cutoffs: at each, all roughness at longer wavelengths is removed."""


class SetsKeys(Keys):
    """Sets: random choices of substitute scans and masters, whose scatter gives intervals."""

    count: Annotated[int, Field(ge=1, le=10000)] = 100
    """Number of sets, each with other scans and masters. With more sets intervals scatter less."""
    pool_size: Annotated[int, Field(ge=2, le=10000)] = 60
    """Scans of each substrate in the pool, from which sets are sampled. With more scans sets share
    fewer of them."""
    rms_height_count: Annotated[int, Field(ge=4, le=50)] = 7
    """Number of rms heights to which each scan of the pool is scaled. Between them forces are
    interpolated."""
    contacts_per_row: types.ContactsPerRow = 10
    """Contacts per row of the array on scans and masters of the sets."""
    masters: types.MasterCount = 20
    """Masters of each substrate for each edge, from which the bands of sets are sampled."""
    short: SetShortSideKeys = SetShortSideKeys()
    long: SetLongSideKeys = SetLongSideKeys()


class ExponentKeys(Keys):
    """Exponents of force and short edge over radius and load, computed on masters of the sets."""

    masters: types.MasterCount = 3
    """Masters of each substrate for each edge, also for `edge_shifts.nc`."""
    radii: types.Radii = key(["5 um", "62.5 um", "250 um", "1000 um"])
    """Radii of the spheres."""


class Study(Keys):
    """All keys of a study, with the rules across keys."""

    study: Annotated[str, types.study_name()] = "paper"
    """Name of the study. Its results are in `results/<study>/`."""
    store: Annotated[str, types.FOLDER] = "results/store"
    """Folder of intermediate files. Studies with the same folder compute no file twice."""
    surfaces: types.FilePath = "config/surfaces.tsv"
    """Table of surfaces, with a row for each scan."""
    scans: Annotated[list[int], Field(min_length=1), types.or_word("all")] = key("all")
    """Numbers of the scans used, such as `[1, 2]`, or `all`. Fewer scans save time and widen
    intervals."""
    published: Literal["paper", "none"] = "paper"
    """Kind of study: `paper` compares it with the paper and judges its statements; `none` is for
    your own surfaces."""
    forces: types.FilePath = "none"
    """With `published: none`: table of forces measured on your surfaces, or `none`."""
    given_quantities: list[Literal["radius", "hardness", "preload", "range", "work"]] = []
    """With `published: none`: quantities that you know. Others with the paper's value are reported
    as assumed."""
    reference_surface: types.SurfaceId = key("uncd", "Fig. 4b")
    """Substrate whose force is the denominator of ratios of forces."""
    seed: Annotated[int, Field(ge=0, le=4294967295)] = 2021
    """Seed of all random numbers. Another seed shows which changes are chance."""
    effort: Literal["full", "quick"] = "full"
    """With `quick` the keys under `quick` replace the others, for a coarser answer sooner."""
    quick: dict[Any, Any] = {}
    """Keys of `effort: quick`, with which the names of study and store end in `-quick`."""
    sphere: SphereKeys = SphereKeys()
    scan: ScanKeys = ScanKeys()
    substitutes: SubstituteKeys = SubstituteKeys()
    contact: ContactKeys = ContactKeys()
    adhesion: AdhesionKeys = AdhesionKeys()
    intervals: IntervalKeys = IntervalKeys()
    band: BandKeys = BandKeys()
    elastic: ElasticKeys = ElasticKeys()
    indent: IndentKeys = IndentKeys()
    asperities: AsperitiesKeys = AsperitiesKeys()
    sets: SetsKeys = SetsKeys()
    exponents: ExponentKeys = ExponentKeys()

    @model_validator(mode="after")
    def _check_rules_across_keys(self) -> "Study":
        raise_faults([*self._effort_faults(), *self._folder_faults(), *self._kind_faults()])
        return self

    def _effort_faults(self) -> Iterator[str]:
        """Yield the faults of the effort and of the names that depend on it."""
        if self.effort == "quick" and not self.quick:
            accepted = "full, because the section quick has no keys"
            found_value = "quick (the quick study of the paper: --configfile config/quick.yaml)"
            yield key_fault("effort", accepted, found_value)
        if quick_names := sorted({"study", "store"} & self.quick.keys()):
            accepted = f"neither study nor store, whose names at quick effort end in {QUICK_SUFFIX}"
            yield key_fault("quick", accepted, " and ".join(quick_names))
        for name_key in ("study", "store"):
            name = getattr(self, name_key)
            if self.quick and self.effort != "quick" and name.endswith(QUICK_SUFFIX):
                accepted = f"a name without the end {QUICK_SUFFIX}, which marks effort: quick"
                yield key_fault(name_key, accepted, name)

    def _folder_faults(self) -> Iterator[str]:
        """Yield the faults of a store that overlaps the results, or is elsewhere in the project."""
        folder = f"results/{self.study}"
        results = Path(os.path.realpath(folder))
        store = Path(os.path.realpath(self.store))
        if results.is_relative_to(store) or store.is_relative_to(results):
            yield key_fault("store", f"a folder apart from {folder}", self.store)
        if store.is_relative_to(os.getcwd()) and not store.is_relative_to(results.parent):
            yield key_fault("store", "a folder in results or outside of the project", self.store)

    def _kind_faults(self) -> Iterator[str]:
        """Yield the faults of keys that the kind of study or a smooth sphere excludes."""
        if self.published == PAPER and self.forces != NONE:
            yield key_fault("forces", f"{NONE} with published: {PAPER}", self.forces)
        is_smooth = self.published != PAPER and self.sphere.surface == SMOOTH_SPHERE
        if is_smooth and self.band.sphere_roughness:
            accepted = f"false with sphere.surface: {SMOOTH_SPHERE}"
            yield key_fault("band.sphere_roughness", accepted, "true")
