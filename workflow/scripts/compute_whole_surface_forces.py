"""Forces on whole substitute surfaces: at all ranges, and with each octave amplified."""

import xarray as xr

from hardcontact.contact.contact import Contact
from hardcontact.contact.geometry import join_bodies
from hardcontact.contact.pull_off import make_force_function, mean_pull_off_dataset
from hardcontact.inference.octaves import octave_force_dataset, octave_limits
from hardcontact.records.job import run_job
from hardcontact.surfaces.featured_scans import summarize_whole_surfaces
from hardcontact.surfaces.height_map import HeightMap

with run_job(snakemake) as job:
    params = job.parameters
    contact = Contact(**params["contact"])

    def forces_on(surface: HeightMap) -> xr.Dataset:
        """Return the forces on a surface as it is, and with each octave amplified."""
        limits = octave_limits(2 * surface.pixel_size, 2 * surface.size)
        bodies = join_bodies(surface, None, contact)
        return octave_force_dataset(surface, limits, make_force_function(contact)).merge(
            mean_pull_off_dataset(bodies, contact, params["ranges"])
        )

    job.write(
        summarize_whole_surfaces(job, forces_on),
        title=f"pull-off forces on whole surfaces of {params['surface']}",
    )
