"""The pull-off forces on the user's surfaces at one range and work of adhesion."""

from hardcontact.base.dataset import read
from hardcontact.contact.contact import Contact
from hardcontact.inference.scan_parts import fewest_touched_patches
from hardcontact.own.force_at_pair import SurfaceDatasets, force_dataset
from hardcontact.own.mean_forces import MasterScans
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    paths = [job.input[name] for name in SurfaceDatasets._fields]
    data = SurfaceDatasets(*(read(path) if path else None for path in paths))
    touched_patches = fewest_touched_patches(data.adhesion)
    job.write(
        force_dataset(
            data,
            Contact(**params["contact"]),
            MasterScans(params["scan_counts"], params["tiles"], touched_patches),
            params["tolerance"],
            params["confidence"],
        ),
        title="pull-off forces at one range and work",
    )
