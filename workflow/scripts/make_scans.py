"""Substitute scans that are conditioned together, as files for scan readers and levelled."""

from functools import partial

from hardcontact.base import dataset, published
from hardcontact.base.job import job
from hardcontact.base.random import generator
from hardcontact.surfaces.conditioning import condition_group, multiply_amplitudes, scan_targets
from hardcontact.surfaces.height_map import LEVELLED, STITCHED, level_and_stitch
from hardcontact.surfaces.spectrum import spectrum_of_dataset
from hardcontact.surfaces.substitute_scans import ScanGrid, synthesize_scan, synthesized_map
from hardcontact.surfaces.substitute_spectra import rows_of_surface

with job(snakemake) as job:
    params = job.parameters
    surface = params["surface"]
    scans = params["scans"]
    grid = ScanGrid(**params["scan"])
    spectrum = dataset.read(job.input.spectrum)
    targets = scan_targets(
        spectrum,
        rows_of_surface(published.table1(job.input.published_table1), surface),
        published.constants(job.input.published_constants),
        grid,
    )
    generator_functions = {
        number: partial(generator, params["seed"], surface, number, "scan") for number in scans
    }
    conditioning = condition_group(spectrum, targets, generator_functions, grid)
    job.write(conditioning, f"gain and factors of substitute scans of {surface}", "conditioning")
    density = multiply_amplitudes(
        spectrum_of_dataset(spectrum), conditioning["amplitude_gain"].values
    )
    for index, number in enumerate(scans):
        # Substitutes of all scans come first among the outputs, then levelled and stitched scans.
        levelled_output = index + len(scans)
        stitched_output = index + 2 * len(scans)
        scan = synthesize_scan(
            generator_functions[number](),
            density,
            grid,
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
