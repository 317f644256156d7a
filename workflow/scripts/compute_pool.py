"""Pull-off forces on some scans of a pool, scaled to several rms heights. Sets sample its scans."""

from hardcontact.contact.contact import Contact
from hardcontact.paper.pool import compute_pool, pool_rms_heights
from hardcontact.records.job import run_job
from hardcontact.surfaces.substitutes import read_substitute, required_targets

with run_job(snakemake) as job:
    params = job.parameters
    scan_numbers = range(params["first"], params["last"] + 1)
    substitute = read_substitute(
        params["surface"], job.input.substitute, params["scan_grid"], params["seed"]
    )
    contact = Contact(**params["contact"])
    targets = required_targets(substitute)
    rms_heights = pool_rms_heights(targets, params["scan_count"], params["rms_height_count"])
    pool = compute_pool(scan_numbers, substitute, rms_heights, contact, params["ranges"])
    span = f"{scan_numbers[0]} to {scan_numbers[-1]}"
    job.write(pool, title=f"pull-off forces of scans {span} of the pool of {params['surface']}")
