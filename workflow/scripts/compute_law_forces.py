"""Forces of a scan and of its filtered masters at the ranges that are mixed for every law."""

from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.contact.contact import Contact
from hardcontact.inference.filtered_masters import Filters
from hardcontact.surfaces.height_map import read_height_map
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.synthesis import SIDES, synthesize_master
from hardcontact.theory.interaction_laws import range_grid
from hardcontact.theory.law_forces import MIXED_RANGES, filtered_range_forces, scan_range_forces

with job(snakemake) as job:
    params = job.parameters
    surface = params["surface"]
    number = params["scan"]
    scan = read_height_map(job.input.scan)
    sphere = read_height_map(job.input.sphere) if job.input.sphere else None
    contact = Contact(radius=params["radius"], **params["contact"])
    law_window = params["window"]
    ranges = range_grid(params["anchor"], **MIXED_RANGES).tolist()
    job.write(
        scan_range_forces(scan, sphere, contact, law_window, ranges),
        title=f"pull-off forces of a scan of {surface} at the ranges of mixtures",
        output="scan",
    )
    for side in SIDES:
        scales = params["scales"][side]
        master = synthesize_master(
            side,
            generator(params["seed"], surface, number, f"{side}-scale laws"),
            scan,
            scales,
            read_spectrum(job.input.spectrum),
        )
        job.write(
            filtered_range_forces(
                master,
                Filters(side, scales["pixels"], scales["cutoffs"]),
                contact,
                law_window,
                ranges,
            ),
            title=f"pull-off forces of a filtered {side}-scale master of {surface} at these ranges",
            output=side,
        )
