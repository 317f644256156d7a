"""Maps of the rigid pull-off force on every scan, and how many contacts and scans a mean needs."""

from hardcontact.adhesion.all_surfaces import with_names
from hardcontact.insight.scan_maps import force_maps
from hardcontact.insight.surface_maps import maps_of_scans
from hardcontact.records.job import job, progress
from hardcontact.surfaces.height_map import read_height_map

with job(snakemake) as this:
    given = this.parameters
    stitched = zip(map(tuple, given["scans"]), this.input.substrates, strict=True)
    maps = {
        scan: force_maps(read_height_map(path), given["settings"])
        for scan, path in progress(stitched, len(given["scans"]), "scans")
    }
    this.write(
        with_names(maps_of_scans(maps, given["settings"]), given),
        title="maps of the rigid pull-off force on a smooth sphere",
    )
