"""The edges of the band of own surfaces, and the force that a work and a range predict."""

from hardcontact.base.dataset import read
from hardcontact.contact.contact import Contact
from hardcontact.inference.edges import labelled_edges
from hardcontact.inference.scan_parts import fewest_touched_patches
from hardcontact.own.edges_of_scans import edges_of_scans
from hardcontact.own.mean_forces import MasterScans
from hardcontact.own.predicted_force import force_dataset
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    adhesion = read(job.input.adhesion)
    scales = read(job.input.scales)
    sensitivity = read(job.input.sensitivity)
    touched_patches = fewest_touched_patches(adhesion)
    master_scans = MasterScans(params["scan_counts"], params["tiles"], touched_patches)
    criteria = {name: params[name] for name in ("tolerance", "confidence")}
    edges = edges_of_scans(scales, sensitivity, master_scans, **criteria)
    job.write(
        labelled_edges(edges, scales, **criteria),
        title="pull-off force against cutoff wavelength, and the edges of the band",
        output="edges",
    )
    job.write(
        force_dataset(
            adhesion,
            scales,
            read(job.input.topography),
            read(job.input.spectra),
            sensitivity,
            contact=Contact(**params["contact"]),
            master_scans=master_scans,
            **criteria,
        ),
        title="predicted pull-off forces",
        output="force",
    )
