"""The roughness of both bodies in one mirrored map, on which a smooth sphere makes contacts."""

from hardcontact.base.arrays import generator
from hardcontact.records.job import run_job
from hardcontact.scans.both_bodies import combine_maps
from hardcontact.surfaces.height_map import load_height_map

with run_job(snakemake) as job:
    params = job.parameters
    seed_words = [params[name] for name in ("surface", "scan", "sphere_scan")]
    bodies = [load_height_map(path) for path in (job.input.substrate, job.input.sphere)]
    job.write(
        combine_maps(generator(params["seed"], *seed_words, "both bodies"), *bodies).to_dataset(),
        title="roughness of a substrate and of the sphere, with mirror images, periodic",
    )
