"""The roughness of both bodies in one mirrored map, on which a smooth sphere makes contacts."""

from hardcontact.base.arrays import generator
from hardcontact.records.job import run_job
from hardcontact.scans.both_bodies import combine_maps
from hardcontact.surfaces.height_map import load_height_map

with run_job(snakemake) as job:
    params = job.parameters
    seed_words = [params[name] for name in ("surface", "scan", "sphere_scan")]
    combined_map = combine_maps(
        generator(params["seed"], *seed_words, "both bodies"),
        substrate=load_height_map(job.input.substrate),
        sphere=load_height_map(job.input.sphere),
    )
    title = "roughness of a substrate and of the sphere, with mirror images, periodic"
    job.write(combined_map.to_dataset(), title)
