"""Pull-off forces on scans of some surfaces with features and the roughness of Table 1."""

from hardcontact.contact.contact import Contact
from hardcontact.paper.featured_candidates import compute_candidates
from hardcontact.records.job import run_job
from hardcontact.surfaces.features import featured_surface
from hardcontact.surfaces.substitutes import read_substitute

with run_job(snakemake) as job:
    params = job.parameters
    features = params["features"]
    substitute = read_substitute(
        params["surface"], job.input.substitute, params["scan_grid"], params["seed"]
    )
    candidates = compute_candidates(
        features,
        range(params["first"], params["last"] + 1),
        featured_surface(substitute),
        params["scan_count"],
        Contact(**params["contact"]),
        params["ranges"],
    )
    title = f"pull-off forces on surfaces of {params['surface']} with features: {features}"
    job.write(candidates, title)
