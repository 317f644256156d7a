"""How high above the mean planes published and computed forces put the apex of the sphere."""

import numpy as np

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.paper.inference import PLASTIC
from hardcontact.paper.standoff import standoff

with job(snakemake) as this:
    topography = dataset.read(this.input.topography)
    sphere = topography["rms_height_mean"].sel(surface=topography.attrs["sphere_surface"])
    this.write(
        standoff(
            dataset.read(this.input.adhesion).sel(contact_model=PLASTIC),
            published.pull_off(this.input.published_pull_off),
            published.constants(this.input.published_constants)["value"]["work_of_adhesion"],
            np.hypot(topography["rms_height_mean"], sphere).to_series(),
        ),
        title="heights of the sphere's apex that follow from pull-off forces",
    )
