"""Forces of surfaces with features at the published range and work of adhesion: features.nc."""

from hardcontact.base import published
from hardcontact.base.dataset import read, read_all
from hardcontact.base.job import job
from hardcontact.contact.contact import PLASTIC
from hardcontact.inference.published_fit import Pair, PublishedFit
from hardcontact.paper.featured_draws import compare_with_published, draws_by_surface, no_draws

with job(snakemake) as job:
    constants = published.constants(job.input.published_constants)["value"]
    published_fit = PublishedFit(
        published.measured_statistics(job.input.published_pull_off),
        Pair(constants["range_of_adhesion"], constants["work_of_adhesion"]),
    )
    factor = read(job.input.sets)["sphere_factor"].sel(contact_model=PLASTIC, drop=True)
    surfaces = draws_by_surface(read_all(job.parameters["draw_chunks"], job.input.draws))
    comparisons = [
        compare_with_published(
            {kind: draws.sel(contact_model=PLASTIC) for kind, draws in kinds.items()},
            factor.sel(surface=surface, drop=True),
            published_fit,
            surface,
        ).assign_attrs(label=job.parameters["labels"][surface])
        for surface, kinds in surfaces.items()
    ]
    job.write(
        # Without substitutes of the surface there are no draws.
        comparisons[0] if comparisons else no_draws(),
        title="forces on surfaces with features at the published range and work of adhesion",
    )
