"""Substitute scans that are made together: levelled, and stitched."""

from functools import partial

from hardcontact.base import dataset, published
from hardcontact.base.job import run_job
from hardcontact.base.random import generator
from hardcontact.paper.featured_scans import describe_group, nearest_group, read_featured_surface
from hardcontact.surfaces.conditioning import condition_group, conditioned_scan, scan_targets
from hardcontact.surfaces.height_map import LEVELLED, STITCHED, level_and_stitch
from hardcontact.surfaces.synthesis import ScanGrid

with run_job(snakemake) as job:
    params = job.parameters
    surface = params["surface"]
    numbers = params["scans"]
    spectrum = dataset.read(job.input.spectrum)
    if params["has_features"]:
        source = read_featured_surface(job.input, params)
        features, scans = nearest_group(source, numbers)
        conditioning = describe_group(features, numbers, spectrum, source.mean_rms_height)
    else:
        grid = ScanGrid(**params["scan"])
        rows = published.rows_of_surface(published.read_table1(job.input.published_table1), surface)
        constants = published.read_constants(job.input.published_constants)
        targets = scan_targets(spectrum, rows, constants, grid)
        generator_functions = {
            number: partial(generator, params["seed"], surface, number, "scan")
            for number in numbers
        }
        conditioning = condition_group(spectrum, targets, generator_functions, grid)
        scans = [
            conditioned_scan(
                make_generator(), spectrum, conditioning.sel(scan=number), grid,
                params["sphere_radius"],
            )
            for number, make_generator in generator_functions.items()
        ]  # fmt: skip
    job.write(conditioning, f"how substitute scans of {surface} meet Table 1", "conditioning")
    for index, scan in enumerate(scans):
        levelled, stitched = level_and_stitch(scan, params["sphere_radius"])
        # Levelled scans come first among the outputs, then stitched scans.
        job.write(levelled, LEVELLED, index)
        job.write(stitched, STITCHED, index + len(scans))
