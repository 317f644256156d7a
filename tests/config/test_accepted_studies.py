"""Studies that are accepted can be computed."""

from dataclasses import replace
from itertools import product

import numpy as np
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st
from repository import PAPER, merge_configurations

from hardcontact.config import selected_surfaces
from hardcontact.config.configuration import get_key, master_keys, numeric_configuration
from hardcontact.config.limits import random_surface_pixels
from hardcontact.contact.attraction import find_carrying_asperities
from hardcontact.contact.bearing_area import all_contact_pixels
from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies, sample_contacts
from hardcontact.contact.indents import indent_sizes
from hardcontact.contact.pull_off import pull_off_dataset
from hardcontact.files.master_purposes import PURPOSES
from hardcontact.inference.filtered_masters import Filters, filtered_pull_off
from hardcontact.run import checks
from hardcontact.surfaces import spectrum, synthesis
from hardcontact.surfaces.height_map import mirror_scan
from hardcontact.surfaces.levelling import level, remove_form
from hardcontact.surfaces.spectrum import WAVEVECTORS, Spectrum
from hardcontact.surfaces.synthesis import add_sphere, cut_scan, synthesize_master


def lengths(low, high, count):
    """Give up to `count` quantities in nm, ascending, often at the ends of the accepted values."""
    length_within_bounds = st.floats(low, high) | st.sampled_from([low * 1.0001, high])
    return st.lists(length_within_bounds, min_size=1, max_size=count).map(
        lambda values: [f"{length:.9g} nm" for length in sorted(set(values))]
    )


@st.composite
def tiny(draw):
    """Give a study on tiny grids, with values at and around the limits of the accepted values."""

    def pick(*values):
        return draw(st.sampled_from(values))

    pixels, pixel, tiles = pick(16, 17, 21, 32), pick(0.5, 4.883, 20.0, 78.0), pick(1, 2, 3)
    small, large = 2 * pixels * pick(1, 2, 3), 2 * pixels * tiles * pick(1, 2)
    period, domain, count = 2 * pixels * pixel, 2 * pixels * tiles * pixel, pick(1, 2, 3)
    hardness, contact_pixel_count = pick(1, 25, 1000), pick(0.1, 1, 2, 17, pixels, pixels**2)
    load = f"{contact_pixel_count * hardness * pixel**2:.6g} nN"
    cutoffs = {
        "short": draw(lengths(2 * period / small, period, 3)),
        "long": draw(lengths(2 * pixel, domain, 3)),
    }
    return {
        "scan": {"pixels": pixels, "size": f"{pixels * pixel:.9g} nm"},
        "sphere": {"radius": f"{max(pixels * pixel, pick(10, 1e4, 2.5e5, 1e9)):.9g} nm"},
        "contact": {
            "contacts_per_row": count,
            "window": f"{period * pick(0.5, 0.99, 1, 2.3):.9g} nm",
            "preload": load,
            "hardness": f"{hardness} GPa",
        },
        "adhesion": {
            "range": pick("0.1 nm", "1 nm", "5.6 nm", "5.6 nm", "1 um"),
            "ranges": [pick("0.1 nm", "0.5 nm", "1 nm"), pick("5 nm", "1 um")],
        },
        "scales": {
            "sphere_roughness": pick(True, False),
            "short": {
                "pixels": small,
                "transition": draw(lengths(2 * pixel, period, 1))[0],
                "cutoffs": cutoffs["short"],
            },
            "long": {
                "pixels": large,
                "tiles": tiles,
                "transition": draw(lengths(2 * pixel, domain, 1))[0],
                "cutoffs": cutoffs["long"],
            },
        },
        "elastic": {"contacts": 1},
        "indent": {"preloads": [f"{4 * contact_pixel_count * hardness * pixel**2:.6g} nN"]},
        "asperities": {"contacts": 1, "ranges": ["0.1 nm", "9 nm"]},
        "sets": {
            "contacts_per_row": pick(1, 2),
            "short": {"pixels": small, "cutoffs": cutoffs["short"]},
            "long": {"pixels": large, "cutoffs": cutoffs["long"]},
        },
        "exponents": {"radii": [f"{pick(10, 1e3, 2.5e5):.9g} nm", "1 m"]},
    }


def accepted(overlay):
    """Return the configuration in numbers, or None if the study is refused."""
    try:
        config = numeric_configuration(merge_configurations(PAPER, overlay))
        table = selected_surfaces.surface_table("config/surfaces.tsv")
        checks.check_study(config, table)
    except ValueError:
        return None
    return config


#: About as rough as MCD, and as the ruby.
ROUGH, SMOOTH = (
    Spectrum(WAVEVECTORS, spectrum.self_affine(WAVEVECTORS, plateau, rolloff=1500.0, hurst=0.9))
    for plateau in (2e9, 5e4)
)


def mirrored_scan(config, rng, density, radius=None):
    """Make a substitute scan as masters and contacts use it."""
    scan = config["scan"]
    pixel_size = scan["size"] / scan["pixels"]
    surface_pixels = random_surface_pixels(scan["pixels"])
    surface = synthesis.random_surface(rng, surface_pixels, pixel_size, density)
    substitute = cut_scan(surface, scan["pixels"])
    if radius is None:
        return mirror_scan(level(substitute))
    return mirror_scan(remove_form(add_sphere(rng, substitute, radius), radius))


def assert_forces(arrays):
    for name in {"pull_off_force", "unfiltered_pull_off_force"} & set(arrays.data_vars):
        forces = arrays[name].values
        assert np.isfinite(forces).all() and (forces > 0).all()


def check_pair(config, rng, substrate, sphere):
    """Compute forces at all contacts and ranges, the largest indents, and asperities."""
    contact = Contact(radius=config["sphere"]["radius"], **config["contact"])
    bodies = join_bodies(substrate, sphere, contact)
    pixel_size = bodies.geometry.pixel_size
    assert_forces(pull_off_dataset(bodies, contact, config["adhesion"]["ranges"]))
    for preload in config["indent"]["preloads"]:
        contact_pixel_count = replace(contact, preload=preload).pixel_count(pixel_size)
        contacts = all_contact_pixels(bodies, contact_pixel_count)
        assert contacts.gaps.shape[-1] == contact_pixel_count
        for index in np.ndindex(contacts.gaps.shape[:2]):
            depth, *_ = indent_sizes(contacts.pixels_of_contact(index), pixel_size)
            assert 0 < depth < np.inf
    carried = config["asperities"]
    positions = sample_contacts(rng, contact.contacts_per_row, carried["contacts"])
    for share in (0.001, 0.5, 0.999):
        carriers = find_carrying_asperities(bodies, contact, positions, share, carried["ranges"])
        assert all(np.isfinite(values).all() for values in carriers.data_vars.values())


def check_masters(config, rng, mirrored, sphere, section, side):
    """Compute forces of one master, filtered at every cutoff, at all that its section asks for."""
    keys = master_keys(config, section, side)
    expected_values = {name: get_key(config, key) for name, key in keys.items()}
    master = synthesize_master(side, rng, mirrored, expected_values, ROUGH)
    filters = Filters(side, expected_values["pixels"], expected_values["cutoffs"])
    count_section = "contact" if section == "scales" else section
    contact = Contact(
        radius=config["sphere"]["radius"],
        rho=config["adhesion"]["range"],
        **config["contact"] | {"contacts_per_row": config[count_section]["contacts_per_row"]},
    )
    probe = sphere if config["scales"]["sphere_roughness"] else None
    assert_forces(filtered_pull_off(master, filters, [contact], probe))
    if section == "scales":
        return
    shares = PURPOSES["exponents"].preload_shares
    contacts = [replace(contact, preload=share * contact.preload) for share in shares]
    radii = config["exponents"]["radii"]
    assert_forces(filtered_pull_off(master, filters, contacts, None, radii))


#: Studies that are computed.
EXAMPLES = 5


def test_every_accepted_study_can_be_computed(project_folder):
    refusals = []

    @given(tiny())
    @settings(
        max_examples=EXAMPLES,
        deadline=None,
        derandomize=True,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    def compute(overlay):
        config = accepted(overlay)
        refusals.append(config is not None)
        assume(config is not None)
        rng = np.random.default_rng(1)
        mirrored = mirrored_scan(config, rng, ROUGH)
        sphere = mirrored_scan(config, rng, SMOOTH, config["sphere"]["radius"])
        check_pair(config, rng, mirrored, sphere)
        for section, side in product(("scales", "sets"), ("short", "long")):
            check_masters(config, rng, mirrored, sphere, section, side)

    compute()
    assert sum(refusals) >= EXAMPLES and not all(refusals)
