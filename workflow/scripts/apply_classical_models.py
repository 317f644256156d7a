"""Effective work of adhesion, and classical models for the published forces: classical.nc."""

from hardcontact.base import published
from hardcontact.base.dataset import read_dataset
from hardcontact.base.statistics import Sampling
from hardcontact.paper.classical_comparison import apply_classical_models
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    constants = published.read_constants(job.input.published_constants)
    comparison = apply_classical_models(
        read_dataset(job.input.fit),
        constants["value"].to_dict(),
        published.read_table1(job.input.published_table1),
        published.read_published_forces(job.input.published_pull_off, dtype=str),  # as printed
        Sampling.from_parameters(job.parameters, "classical"),
    )
    job.write(comparison, "effective work of adhesion, and classical models of rough adhesion")
