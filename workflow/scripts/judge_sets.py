"""The numbers of many equally good sets of substitute scans, all sets in one dataset."""

import pandas as pd

from hardcontact.base import published
from hardcontact.base.dataset import read, read_all
from hardcontact.base.job import job
from hardcontact.contact.all_surfaces import single_masters, stacked_forces
from hardcontact.paper.inference import Pair, Published
from hardcontact.paper.judged_sets import SetSettings, gathered_sources, judge_sets

with job(snakemake) as this:
    given = this.parameters
    constants = published.constants(this.input.published_constants)
    pair = Pair(*constants.loc[["range_of_adhesion", "work_of_adhesion"], "value"])
    keys = [[surface] for surface in given["masters"]]
    masters = zip(keys, map(read, this.input.masters), strict=True)
    sources = gathered_sources(
        {name: read(this.input[name]) for name in ("topography", "adhesion")},
        read_all(given["chunks"], this.input.pools),
        dict(zip(given["pooled"], map(read, this.input.smooth_spheres), strict=True)),
        stacked_forces(single_masters(masters, given["realizations"], given["load"])),
    )
    judged = judge_sets(
        sources,
        pd.DataFrame(given["statements"]),
        constants,
        Published(published.pull_off(this.input.published_pull_off), pair),
        SetSettings(**given["settings"]),
    )
    this.write(
        judged.assign_attrs(confidence=given["settings"]["confidence"]),
        title="numbers of many sets of substitute scans",
    )
