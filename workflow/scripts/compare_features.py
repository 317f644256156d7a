"""Forces of surfaces with features at the published range and work of adhesion: features.nc."""

from hardcontact.base import published
from hardcontact.base.dataset import read, read_all
from hardcontact.contact.contact import PLASTIC
from hardcontact.paper.featured_samples import (
    compare_with_published,
    empty_comparison,
    samples_by_surface,
)
from hardcontact.paper.published_fit import Pair, PublishedForces
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    constants = published.read_constants(job.input.published_constants)["value"]
    published_forces = PublishedForces(
        published.read_measured_statistics(job.input.published_pull_off),
        Pair(constants["range_of_adhesion"], constants["work_of_adhesion"]),
    )
    factor = read(job.input.sets)["sphere_factor"].sel(contact_model=PLASTIC, drop=True)
    surfaces = samples_by_surface(read_all(job.parameters["sample_chunks"], job.input.samples))
    comparisons = [
        compare_with_published(
            {kind: samples.sel(contact_model=PLASTIC) for kind, samples in kinds.items()},
            factor.sel(surface=surface, drop=True),
            published_forces,
            surface,
        ).assign_attrs(label=job.parameters["labels"][surface])
        for surface, kinds in surfaces.items()
    ]
    job.write(
        # Without substitutes of the surface there are no samples.
        comparisons[0] if comparisons else empty_comparison(),
        title="forces on surfaces with features at the published range and work of adhesion",
    )
