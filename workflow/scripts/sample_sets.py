"""The numbers of many sets of substitute scans, all sets in one dataset."""

import pandas as pd

from hardcontact.base import published
from hardcontact.base.dataset import read, read_all
from hardcontact.inference.filtered_masters import read_master_forces
from hardcontact.paper.published_fit import PublishedForces
from hardcontact.paper.sets import SetSettings, gather_inputs, sample_sets
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    inputs = gather_inputs(
        topography=read(job.input.topography),
        adhesion=read(job.input.adhesion),
        pool_chunks=read_all(params["pool_chunks"], job.input.pools),
        candidate_chunks=read_all(params["candidate_chunks"], job.input.candidates),
        sampled_substrates=params["sampled_substrates"],
        masters=read_master_forces(
            params["master_surfaces"], job.input.masters, params["realizations"], params["loading"]
        ),
    )
    set_numbers = sample_sets(
        inputs,
        pd.DataFrame(params["claims"]),
        published.read_constants(job.input.published_constants),
        PublishedForces.read(job.input.published_pull_off, job.input.published_constants),
        SetSettings(**params["settings"]),
    )
    job.write(
        set_numbers.assign_attrs(confidence=params["settings"]["confidence"]),
        title="numbers of many sets of substitute scans",
    )
