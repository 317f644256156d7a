"""Ranges and works of adhesion that agree with the user's measured forces: fit.nc."""

from hardcontact.base.dataset import read_dataset
from hardcontact.base.statistics import Sampling
from hardcontact.config.force_table import read_forces
from hardcontact.inference.measured_fit import add_extrapolated_work, fit_measured
from hardcontact.own.wide_pixels import surface_pixel_factors
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    adhesion = read_dataset(job.input.adhesion)
    surfaces = adhesion["surface"].values.tolist()
    force = read_dataset(job.input.force)
    scan_sizes = read_dataset(job.input.topography)["scan_size"].to_series().to_dict()
    fitted = fit_measured(
        adhesion,
        read_forces(job.input.forces, surfaces, adhesion.attrs["sphere_radius"]),
        scan_sizes,
        surface_pixel_factors(force).to_series().to_dict(),
        Sampling.from_parameters(job.parameters),
    )
    job.write(
        add_extrapolated_work(fitted, force),
        title="range and work of adhesion from measured forces",
    )
