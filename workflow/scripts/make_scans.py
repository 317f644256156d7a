"""Substitute scans that are conditioned together, as files for scan readers and levelled."""

from hardcontact.base import dataset
from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.surfaces.conditioning import multiply_amplitudes
from hardcontact.surfaces.height_map import LEVELLED, STITCHED, level_and_stitch
from hardcontact.surfaces.spectrum import read_spectrum
from hardcontact.surfaces.substitute_scans import ScanGrid, synthesize_scan, synthesized_map

with job(snakemake) as job:
    params = job.parameters
    surface = params["surface"]
    scans = params["scans"]
    conditioning = dataset.read(job.input.conditioning)
    density = multiply_amplitudes(
        read_spectrum(job.input.spectrum), conditioning["amplitude_gain"].values
    )
    for index, number in enumerate(scans):
        # Substitutes of all scans come first among the outputs, then levelled and stitched scans.
        levelled_output = index + len(scans)
        stitched_output = index + 2 * len(scans)
        scan = synthesize_scan(
            generator(params["seed"], surface, number, "scan"),
            density,
            ScanGrid(**params["scan"]),
            float(conditioning["factor"].sel(scan=number)),
            sphere_radius=params["sphere_radius"],
        )
        job.write(
            scan,
            title=f"substitute scan {number} of {surface}",
            output=index,
            file_format="NETCDF3_64BIT",
        )
        levelled_scan, stitched_scan = level_and_stitch(
            synthesized_map(scan, job.output[index]), params["sphere_radius"]
        )
        job.write(levelled_scan, LEVELLED, levelled_output)
        job.write(stitched_scan, STITCHED, stitched_output)
