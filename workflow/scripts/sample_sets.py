"""The numbers of many sets of substitute scans, all sets in one dataset."""

import pandas as pd

from hardcontact.base import published
from hardcontact.base.dataset import concatenate, read_by_key, read_dataset
from hardcontact.inference.forces_on_masters import read_master_forces
from hardcontact.inference.published_fit import PublishedForces
from hardcontact.paper.featured_candidates import candidates_by_surface
from hardcontact.paper.sets import SetInputs, SetSettings, sample_sets, sphere_factor
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    adhesion = read_dataset(job.input.adhesion)
    constants = published.read_constants(job.input.published_constants)
    published_forces = PublishedForces.read(
        job.input.published_pull_off, job.input.published_constants
    )
    pool_chunks = concatenate(read_by_key(params["pool_chunks"], job.input.pools), "scan")
    pools = {surface: pool for (surface,), pool in pool_chunks.items()}
    candidate_chunks = read_by_key(params["candidate_chunks"], job.input.candidates)
    candidates = candidates_by_surface(candidate_chunks)
    inputs = SetInputs(
        topography=read_dataset(job.input.topography),
        adhesion=adhesion,
        pools=pools,
        candidates=candidates,
        sphere_factor=sphere_factor(adhesion, [*pools, *candidates]),
        master_forces=read_master_forces(
            params["master_surfaces"], job.input.master_forces, params["loading"]
        ),
    )
    settings = SetSettings(**params["settings"])
    sets = sample_sets(
        inputs, pd.DataFrame(params["claims"]), constants, published_forces, settings
    )
    sets.attrs["confidence"] = settings.confidence
    job.write(sets, title="numbers of many sets of substitute scans")
