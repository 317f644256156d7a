"""Ranges and works of adhesion that agree with your measured forces: fit.nc."""

from hardcontact.base.dataset import read_dataset
from hardcontact.base.statistics import Sampling
from hardcontact.config.force_table import read_forces
from hardcontact.inference.measured_fit import add_extrapolated_work, fit_measured
from hardcontact.own.wide_pixels import pixel_divisors
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    adhesion = read_dataset(job.input.adhesion)
    force = read_dataset(job.input.force)
    topography = read_dataset(job.input.topography)
    surfaces = adhesion["surface"].values.tolist()
    fitted = fit_measured(
        adhesion,
        read_forces(job.input.forces, surfaces, adhesion.attrs["sphere_radius"]),
        topography["scan_size"].to_series().to_dict(),
        pixel_divisors(force).to_series().to_dict(),
        Sampling.from_parameters(job.parameters),
    )
    fitted = add_extrapolated_work(fitted, force)
    job.write(fitted, title="range and work of adhesion from measured forces")
