"""Which second sphere tells the pairs of range and work of adhesion apart that fit the forces."""

import pandas as pd

from hardcontact.adhesion.all_surfaces import stacked_forces, with_names
from hardcontact.insight.next_sphere import (
    PAIRS,
    RADII,
    Known,
    Spheres,
    checked_changes,
    next_spheres,
)
from hardcontact.numbers.statistics import lognormal_shape
from hardcontact.records import published
from hardcontact.records.dataset import read_all
from hardcontact.records.job import job
from hardcontact.surfaces.spectrum import read_spectrum

with job(snakemake) as this:
    given, constants = this.parameters, published.constants(this.input.published_constants)["value"]
    forces = published.pull_off(this.input.published_pull_off)
    table = published.table1(this.input.published_table1).set_index(["quantity", "surface"])
    pairs = pd.read_csv(this.input.pairs, index_col="pair").loc[list(PAIRS)]
    spectra = dict(zip(given["surfaces"], map(read_spectrum, this.input.spectra), strict=True))
    heights = table.loc["all_rms_height"]
    surfaces = {
        name: Known(
            spectrum,
            float(heights["uncertainty"][name] / heights["value"][name]),
            float(forces["mean_force"][name]),
            float(lognormal_shape(forces["mean_force"][name], forces["median_force"][name])),
        )
        for name, spectrum in spectra.items()
    }
    tests = int(constants["tests_per_surface_lower_bound"])
    spheres = Spheres(
        **given["spheres"],
        radii=sorted({*RADII, given["spheres"]["radius"]}),
        tests=tests,
        spheres=tests // int(constants["tests_per_array"]),
        floor=float(constants["force_floor"]),
    )
    masters = stacked_forces(read_all(given["masters"], this.input.masters))
    mean = masters["unfiltered_pull_off_force"].sel(side="large").mean("realization")
    computed = {name: mean.sel(surface=name) for name in spectra}
    of_range = pairs[["range_of_adhesion_nm", "range_log_deviation"]]
    found = next_spheres(surfaces, dict(zip(PAIRS, of_range.values, strict=True)), spheres)
    this.write(
        with_names(found, {"labels": given["labels"], "basis": given["basis"]}).assign_attrs(
            checked_changes(computed, spectra, spheres),
            sphere_radius=spheres.radius,
            preload=spheres.preload,
            tests=spheres.tests,
            spheres=spheres.spheres,
            ranges=pairs["range_of_adhesion_nm"].tolist(),
            works=pairs["work_of_adhesion_J_m2"].tolist(),
        ),
        title="spheres that tell the pairs of range and work of adhesion apart",
    )
