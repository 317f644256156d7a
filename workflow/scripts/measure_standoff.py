"""How high above the mean planes published and computed forces put the apex of the sphere."""

import numpy as np

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.paper.inference import PLASTIC
from hardcontact.paper.standoff import standoff

with job(snakemake) as job:
    topography = dataset.read(job.input.topography)
    sphere = topography["rms_height_mean"].sel(surface=topography.attrs["sphere_surface"])
    job.write(
        standoff(
            dataset.read(job.input.adhesion).sel(contact_model=PLASTIC),
            published.pull_off(job.input.published_pull_off),
            published.constants(job.input.published_constants)["value"]["work_of_adhesion"],
            np.hypot(topography["rms_height_mean"], sphere).to_series(),
        ),
        title="heights of the sphere's apex that follow from pull-off forces",
    )
