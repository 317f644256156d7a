"""Forces on whole substitute surfaces with all roughness, and with parts of it by bands."""

from hardcontact.base import published
from hardcontact.base.dataset import read_dataset, stack
from hardcontact.contact.contact import Contact
from hardcontact.contact.pull_off import make_force_function
from hardcontact.inference.band_forces import band_force_dataset
from hardcontact.inference.edges import averaged_band
from hardcontact.records.job import run_job
from hardcontact.surfaces.features import whole_surfaces
from hardcontact.surfaces.substitutes import read_substitute

with run_job(snakemake) as job:
    params = job.parameters
    compute_forces = make_force_function(Contact(**params["contact"]))
    substitute = read_substitute(
        params["surface"], job.input.substitute, params["scan_grid"], params["seed"]
    )
    constants = published.read_constants(job.input.published_constants)["value"]
    bands = {
        "published": (constants["short_edge"], constants["long_edge"]),
        "computed": averaged_band(read_dataset(job.input.edges)),
    }
    forces = {}
    for number, height_map in whole_surfaces(substitute, job.input.description, params):
        band_forces = band_force_dataset(height_map, bands, compute_forces)
        forces[(number,)] = band_forces.assign_attrs(period=height_map.size)
    title = f"pull-off forces of {params['surface']} with a part of the roughness"
    job.write(stack(forces, ["map"]), title)
