"""The pull-off forces on the user's surfaces at the work of adhesion of the study: force.nc."""

from hardcontact.base.dataset import read_dataset
from hardcontact.contact.contact import Contact
from hardcontact.inference.mean_forces import MasterScans
from hardcontact.inference.scan_parts import fewest_touched_patches
from hardcontact.own.force_dataset import (
    add_closed_form,
    add_extrapolated_force,
    add_sizes,
    bound_by_smooth_sphere,
    contacts_needed,
    find_extrapolated_forces,
    forces_on_scans,
    widen_intervals,
)
from hardcontact.records.job import run_job

with run_job(snakemake) as job:
    params = job.parameters
    tolerance, confidence = params["tolerance"], params["confidence"]
    contact = Contact(**params["contact"])
    adhesion = read_dataset(job.input.adhesion)
    topography = read_dataset(job.input.topography)
    filtered_forces = read_dataset(job.input.filtered_forces)
    hindcast = read_dataset(job.input.hindcast) if job.input.hindcast else None
    scan_sizes = topography["scan_size"].to_series().to_dict()
    scan_forces = forces_on_scans(adhesion, contact, scan_sizes, confidence)
    touched_patches = fewest_touched_patches(adhesion)
    master_scans = MasterScans(params["scan_counts"], params["tiles"], touched_patches)
    extrapolated_forces = find_extrapolated_forces(
        filtered_forces, master_scans, contact.work, confidence
    )
    # The force on scans and the extrapolated one are compared before their intervals are widened.
    force = add_extrapolated_force(scan_forces, extrapolated_forces, tolerance)
    force = widen_intervals(force, hindcast)
    force = bound_by_smooth_sphere(force, contact.area)
    force = add_closed_form(force, read_dataset(job.input.spectra), contact)
    force = add_sizes(force, topography, contact)
    needed = contacts_needed(adhesion["pull_off_force"], tolerance, confidence)
    job.write(force.assign(contacts_needed=needed), title="pull-off forces on the surfaces")
