"""The edges of the band of your surfaces: edges.nc."""

from hardcontact.base.dataset import read_dataset
from hardcontact.inference.edges import edges_of_shared_scans, labelled_edges
from hardcontact.inference.mean_forces import MasterScans
from hardcontact.inference.scan_parts import fewest_touched_patches
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    tolerance, confidence = params["tolerance"], params["confidence"]
    filtered_forces = read_dataset(job.input.filtered_forces)
    hindcast = read_dataset(job.input.hindcast) if job.input.hindcast else None
    touched_patches = fewest_touched_patches(read_dataset(job.input.adhesion))
    master_scans = MasterScans(params["scan_counts"], params["tiles"], touched_patches)
    edges = edges_of_shared_scans(filtered_forces, hindcast, master_scans, tolerance, confidence)
    edges = labelled_edges(edges, filtered_forces, tolerance, confidence)
    job.write(edges, title="pull-off force against cutoff wavelength, and the edges of the band")
