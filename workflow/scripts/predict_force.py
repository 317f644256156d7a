"""The pull-off forces that a work and a range of adhesion predict."""

from hardcontact.adhesion.finite_scan import (
    with_contact_area,
    with_finite_scans,
    with_window_share,
)
from hardcontact.insight.closed_form import Contact, contact_area
from hardcontact.insight.edge_scaling import among_regimes
from hardcontact.insight.force_scatter import force_scatter
from hardcontact.insight.summits import draw_size
from hardcontact.own_surfaces.master_forces import Masters
from hardcontact.own_surfaces.predicted_force import (
    continued_force,
    predicted_force,
    with_continued_force,
    with_smooth_bound,
)
from hardcontact.records import dataset
from hardcontact.records.job import job
from hardcontact.surfaces.spectrum import spectrum_from

with job(snakemake) as this:
    given, topography = this.parameters, dataset.read(this.input.topography)
    sizes = topography["scan_size"].to_series().to_dict()
    force = predicted_force(
        dataset.read(this.input.adhesion),
        work=given["work"],
        rho=given["rho"],
        sizes=sizes,
        confidence=given["confidence"],
    )
    continued = continued_force(
        dataset.read(this.input.scales),
        Masters(given["scans"], given["tiles"]),
        given["work"],
        given["confidence"],
    )
    force = with_continued_force(force, continued, given["tolerance"])
    area = contact_area(given["contact"]["preload"], given["contact"]["hardness"])
    force = with_smooth_bound(force, area)
    spectra = dataset.read(this.input.spectra)
    joined = {
        name: spectrum_from(spectra.sel(surface=name)) for name in force["surface"].values.tolist()
    }
    draw_sizes = {name: draw_size(one, given["radius"], area) for name, one in joined.items()}
    force = with_finite_scans(force, topography, draw_sizes)
    force = with_window_share(force, given["contact"]["window"], given["radius"])
    contact = Contact(given["radius"], given["rho"], given["work"], area)
    one_scan, settings = dict.fromkeys(joined, 0.0), ("tolerance", "confidence")
    scatter = force_scatter(
        joined, contact, [contact.rho], one_scan, {name: given[name] for name in settings}
    ).squeeze("rho", drop=True)
    force = force.merge(scatter[["modulus", "spread", "contacts_needed"]])
    force = force.merge(among_regimes(joined, contact))
    this.write(
        with_contact_area(force, topography, area),
        title="predicted pull-off forces",
    )
