"""Masters of a scan: one with random waves below the short transition, one above the long."""

from hardcontact.records.job import run_job
from hardcontact.surfaces.height_map import load_height_map
from hardcontact.surfaces.spectrum import load_spectrum
from hardcontact.surfaces.synthesis import STUDY_STREAM, master_generator, synthesize_master

with run_job(snakemake) as job:
    params = job.parameters
    surface, realization = params["surface"], params["realization"]
    scan = load_height_map(job.input.scan)
    spectrum = load_spectrum(job.input.spectrum)
    for side, settings in params["sides"].items():
        rng = master_generator(params["seed"], surface, realization, side, STUDY_STREAM)
        master = synthesize_master(side, rng, scan, settings, spectrum)
        title = f"{side}-edge master: realization {realization} of {surface}"
        job.write(master.to_dataset(), title, side)
