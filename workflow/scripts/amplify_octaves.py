"""Forces on a measured scan with each octave of its own waves amplified."""

from hardcontact.base.job import job
from hardcontact.contact.contact import Contact
from hardcontact.inference.octaves import forces_with, octave_limits, octaves_of_surface
from hardcontact.surfaces.height_map import read_height_map

with job(snakemake) as job:
    params = job.parameters
    stitched = read_height_map(job.input.stitched)
    sphere = read_height_map(job.input.sphere) if job.input.sphere else None
    # A stitched scan is twice as long as the scan, whose mirror images add no longer waves.
    limits = octave_limits(2 * stitched.pixel_size, stitched.size / 2)
    octaves = octaves_of_surface(
        stitched, limits, forces_with(Contact(**params["contact"]), sphere)
    )
    octaves = octaves.expand_dims(map=[params["scan"]]).assign_attrs(map_size=stitched.size / 2)
    job.write(octaves, title="pull-off forces of one scan with each octave amplified")
