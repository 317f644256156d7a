"""The command line of `hardcontact new`: its arguments and their faults."""

import os
import re
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Iterator, Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

from hardcontact.base.code import LIBRARY
from hardcontact.base.units import magnitude
from hardcontact.config.configuration import get_key, read_yaml
from hardcontact.config.key_types import STUDY_NAME, UNIT
from hardcontact.config.model import QUICK_NAME, quantity
from hardcontact.config.selection import LABEL, TIP_RADIUS
from hardcontact.contact.smooth_sphere import STRONGEST_WORK
from hardcontact.surfaces.height_map import LEVELLING

#: The top folder, whose paths studies are named relative to.
ROOT = LIBRARY.parents[1]
#: Id and label of the sphere's surface.
SPHERE = "sphere"
#: Names of studies whose files or results are the project's own.
TAKEN = ("config", "paper", "quick", "surfaces")
#: Options that are quantities: the key of the configuration, and their meaning.
QUANTITIES = {
    "radius": ("sphere.radius", "radius of the sphere"),
    "hardness": ("contact.hardness", "hardness of the softer body"),
    "preload": ("contact.preload", "load on a contact"),
    "range": ("scales.range", "range of adhesion"),
    "work": ("adhesion.work", "work of adhesion of the predicted force"),
}
#: The usual values of quantities; beyond them the unit may be wrong. Sources: spheres and loads of
#: microscopes, lenses of the surface forces apparatus: Butt et al., Surf. Sci. Rep. 59 (2005) 1;
#: diamond: Brazhkin et al., Phil. Mag. A 82 (2002) 231; long ranges: DelRio et al., Nature Mater. 4
#: (2005) 629; works of adhesion: Israelachvili, Intermolecular and Surface Forces (2011).
PLAUSIBLE = {
    "radius": ("1 um", "50 mm", "spheres in pull-off tests, from colloidal probes to lenses"),
    "hardness": ("1 MPa", "150 GPa", "solids that yield, from soft plastics to diamond"),
    "preload": ("100 pN", "10 mN", "loads of microscopes and of microtesters"),
    "range": ("0.2 nm", "40 nm", "ranges from atomic bonds to long dispersion forces"),
    "work": ("0.1 mJ/m2", f"{STRONGEST_WORK:g} J/m2", "solids, up to diamond on itself"),
}
#: Ids that surfaces cannot have: they stand for the mean over surfaces and for a smooth sphere.
TAKEN_IDS = ("pooled", "smooth")
DESCRIPTION = """\
Read scans of your own surfaces, tell what is in them, choose what can be computed,
and write config/NAME.yaml and config/NAME.tsv:

  hardcontact new my-coating scans/*.di twin.zip --radius 250um --preload 10uN
  snakemake --configfile config/my-coating.yaml

Several surfaces, each with its label and its files:

  hardcontact new both --surface bare scans/bare/*.di --surface coated scans/coated/*.di

`hardcontact predict --help` tells how to predict a force from a power spectral density.
"""


class Option(NamedTuple):
    """A quantity, as written text and as a number; from the user, or the paper's value."""

    text: str
    number: float
    unit: str
    is_given: bool


class Source(NamedTuple):
    """A file of a surface: the surface's id and label, where to read it, its path in the table."""

    surface: str
    label: str
    file: str
    path: str
    sphere_radius: float | None = None  #: in nm, of scans of the sphere


def parse_arguments(arguments: Sequence[str]) -> Namespace:
    """Return the parsed command line, without the program's name; a wrong one ends the program."""
    parser = ArgumentParser(
        "hardcontact", description=DESCRIPTION, formatter_class=RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )  # fmt: skip
    parser.add_argument("--version", action="version", version=version("hardcontact"))
    parser.add_argument(
        "command", choices=["new", "predict"], metavar="{new,predict}",
        help="new: make a study of own surfaces; predict: a force from a spectrum, see "
        "hardcontact predict --help",
    )  # fmt: skip
    parser.add_argument("name", metavar="NAME", help="of the study: results/NAME/")
    parser.add_argument(
        "files", metavar="FILE", nargs="*", help="scans, line scans or containers of one surface"
    )
    parser.add_argument(
        "--surface", nargs="+", action="append", default=[], metavar=("LABEL", "FILE"),
        help="a label and the files of a surface; again for each surface",
    )  # fmt: skip
    parser.add_argument(
        "--sphere", nargs="+", default=[], metavar="FILE",
        help="scans of the sphere where it touches; without them it is smooth",
    )  # fmt: skip
    add_shared_options(parser)
    parser.add_argument(
        "--channel", default="", metavar="NAME",
        help="of all files but containers, or its number (the first of heights)",
    )  # fmt: skip
    parser.add_argument("--forces", metavar="CSV", help="own pull-off forces, with their units")
    parser.add_argument(
        "--overwrite", action="store_true",
        help="replace the files of a study of this name, and with the next run its results",
    )  # fmt: skip
    return parser.parse_intermixed_args(arguments)


def add_shared_options(parser: ArgumentParser) -> None:
    """Add the options of both commands: QUANTITIES, and properties that files may not state."""
    paper = read_yaml("config/config.yaml")
    for name, (key, meaning) in QUANTITIES.items():
        parser.add_argument(f"--{name}", help=f"{meaning} (the paper's: {get_key(paper, key)})")
    parser.add_argument("--tip", help="radius of the tip, for the files that do not state it")
    parser.add_argument(
        "--unit", default="none",
        help="unit of length, for the files that do not state it; of points x, y, height two are "
        "of positions and of heights, such as mm,nm",
    )  # fmt: skip
    parser.add_argument(
        "--size", help="longer edge of the scan, for the files that do not state it"
    )
    parser.add_argument(
        "--levelling", choices=LEVELLING, default="plane",
        help="what is subtracted of maps: a plane, offsets of lines, or a quadratic polynomial",
    )  # fmt: skip


def parse_quantities(arguments: Namespace) -> tuple[dict[str, Option], list[str]]:
    """Return the quantities of the command line by name, and a line for each faulty quantity.

    Tip, size and modulus are included only if the user gave them. A faulty quantity has the paper's
    value.
    """
    paper = read_yaml("config/config.yaml")
    accepted = {name: quantity(key) for name, (key, _) in QUANTITIES.items()}
    accepted |= {"tip": TIP_RADIUS, "size": quantity("scan.size"), "modulus": accepted["hardness"]}
    quantities, faults = {}, []
    try:
        UNIT.check(arguments.unit)
    except ValueError as error:
        faults.append(f"--unit: {error}")
    for name, bounds in accepted.items():
        text = getattr(arguments, name, None)
        try:
            if text is not None:
                quantities[name] = Option(text.strip(), bounds.number(text), bounds.unit, True)
        except ValueError as error:
            faults.append(f"--{name}: {error}")
        if name in QUANTITIES and name not in quantities:
            usual = get_key(paper, QUANTITIES[name][0])
            quantities[name] = Option(usual, bounds.number(usual), bounds.unit, False)
    return quantities, faults


def questioned_quantities(quantities: Mapping[str, Option]) -> Iterator[str]:
    """Yield a line for each quantity of the user that is not PLAUSIBLE."""
    for name, (low, high, kind) in PLAUSIBLE.items():
        option = quantities[name]
        lowest, highest = (magnitude(text, option.unit) for text in (low, high))
        if option.is_given and not lowest <= option.number <= highest:
            yield f"--{name} {option.text}: is the unit right? {low} to {high} are usual of {kind}"


def name_faults(arguments: Namespace) -> Iterator[str]:
    """Yield a line for each fault of the name of a study."""
    name = arguments.name
    try:
        # The quick study beside it must have a name, too.
        STUDY_NAME.check(f"{name}{QUICK_NAME}")
    except ValueError:
        accepted = STUDY_NAME.expects.replace("100", str(100 - len(QUICK_NAME)))
        yield f"NAME: expected {accepted}, no blanks, found {name!r}"
        return
    if arguments.files:
        yield from _label_faults("NAME", name)
    if name.endswith(QUICK_NAME):
        yield f"NAME: expected another end than {QUICK_NAME}, that of a first answer, found {name}"
    elif name in TAKEN:
        yield f"NAME: expected one of your own, found {name}, which is the project's"
    elif not arguments.overwrite:
        results = (f"results/{name}", f"results/{name}{QUICK_NAME}")  # of these or of other inputs
        for file in (f"config/{name}.yaml", f"config/{name}.tsv", *results):
            if os.path.lexists(ROOT / file):
                yield f"{file}: expected none, found one: take another name, or --overwrite"


def _label_faults(option: str, label: str) -> Iterator[str]:
    """Yield a line if figures cannot have a label."""
    try:
        LABEL.check(label)
    except ValueError as error:
        yield f"{option}: label: {error}"


def list_sources(arguments: Namespace, radius: float) -> tuple[list[Source], list[str]]:
    """Return the files of all surfaces, the sphere's last, and a line for each fault.

    The radius of the sphere is in nm.
    """
    surfaces = [(arguments.name, arguments.files)] if arguments.files else []
    surfaces += [(label, files) for label, *files in arguments.surface]
    faults = [] if surfaces else ["FILE: expected files of scans, found none"]
    for label, *files in arguments.surface:
        faults += _label_faults("--surface", label)
        if not files:
            faults.append(f"--surface {label}: expected files of scans, found none")
    surfaces += [(SPHERE, arguments.sphere)] if arguments.sphere else []
    files_of_all: list[Source] = []
    labels: dict[str, str] = {}
    for label, files in surfaces:
        surface = surface_id(label)
        if surface in labels:
            faults.append(
                f"--surface {labels[surface]}: expected a label of its own, small and capital "
                f"letters and signs alike, found also {label}"
            )
        labels.setdefault(surface, label)
        sphere_radius = radius if files is arguments.sphere else None
        files_of_all += [
            Source(surface, label, file, path_from_root(file), sphere_radius) for file in files
        ]
    paths = [source.path for source in files_of_all]
    faults += [
        f"{path}: expected each file once, found it {paths.count(path)} times"
        for path in dict.fromkeys(paths)
        if paths.count(path) > 1
    ]
    return files_of_all, faults


def surface_id(label: str) -> str:
    """Return the id of a surface: its label in lower case, other characters as underscores."""
    name = re.sub(r"[^a-z0-9]+", "_", label.lower()).strip("_")
    if name in TAKEN_IDS or not re.match("[a-z]", name):
        name = f"surface_{name}".rstrip("_")
    return name[:40].rstrip("_")


def path_from_root(file: str) -> str:
    """Return a path relative to the top folder; an absolute path to elsewhere stays absolute."""
    absolute = os.path.abspath(file)
    if os.path.isabs(file) and not Path(absolute).is_relative_to(ROOT):
        return absolute
    return os.path.relpath(absolute, ROOT)
