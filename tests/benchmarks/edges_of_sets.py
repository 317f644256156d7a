"""Edges of the band in sets: with other numbers of sets or masters, or with another ratio.

    python tests/benchmarks/edges_of_sets.py [results/paper] [--sets 3000] [--masters 20]

For each claim on an edge, this prints the edge of the study's own masters, median and central 95 %
of the sets, and how many sets agree with the paper. By default the sets are those of the study.
More of them show how the share depends on chance (3000 take eight minutes), more masters how it
would change with more scans of each coating.

The paper does not say which ratio Fig. 6 shows. The study divides the force on each filtered master
by that on the same master, and takes the mean of these ratios. The other ratio is that of two mean
forces, in which masters with large forces count most.
"""

import argparse
import json
from pathlib import Path

import pandas as pd
import xarray as xr

from hardcontact.base.statistics import Sampling
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.inference.edges import AVERAGED, edges_of_independent_masters
from hardcontact.inference.forces_on_masters import read_master_forces
from hardcontact.paper.claims.band_quantities import band_edge, outermost_edge
from hardcontact.paper.claims.verdicts import read_judged_claims
from hardcontact.paper.sets import sample_masters

#: Forces on masters, without and with all roughness.
FORCES = ("pull_off_force", "unfiltered_pull_off_force")


def claimed_edges(filtered_forces, ratio, settings):
    """Return the edges in nm by the id of their claim, from ratios (surface, realization, ...)."""
    sampling = Sampling(settings["seed"], 0, settings["confidence"])  # no samples, only edges
    ratios = filtered_forces.drop_dims("realization").assign(filtered_force_ratio=ratio)
    edges, _ = edges_of_independent_masters(ratios, settings["tolerance"], sampling)
    edges_by_kind = {
        "outermost": outermost_edge(edges),
        "averaged": band_edge(edges).sel(group=AVERAGED),
    }
    return {
        f"{kind}_{side}_edge": edge["value"].sel(side=side).item()
        for kind, edge in edges_by_kind.items()
        for side in ("short", "long")
    }


def both_ratios(filtered, unfiltered):
    """Return what is averaged over masters, by the name of the ratio."""
    return {
        "mean of the ratios": filtered / unfiltered,
        "ratio of the means": filtered / unfiltered.mean("realization"),
    }


def edges_of_sets(forces_of_sets, set_count, master_count, settings):
    """Return the edges in nm of sets: by ratio, a row for each set and a column for each claim."""
    mean_forces = [forces_of_sets[name].mean(CONTACT_AXES) for name in FORCES]
    rows = []
    for set_number in range(1, set_count + 1):
        samples = (
            sample_masters(forces, master_count, settings["seed"], set_number)
            for forces in mean_forces
        )
        for name, ratio in both_ratios(*samples).items():
            rows.append({"ratio": name} | claimed_edges(forces_of_sets, ratio, settings))
    return pd.DataFrame(rows).set_index("ratio")


def main():
    """Print the edges of a finished study by both ratios, for its own masters and for sets."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("study", nargs="?", default="results/paper", type=Path)
    parser.add_argument("--sets", type=int, help="number of sets (default: the study's)")
    parser.add_argument("--masters", type=int, help="masters a set (default: the study's)")
    arguments = parser.parse_args()
    study = arguments.study
    filtered_forces, sets = (
        xr.load_dataset(study / name) for name in ("filtered_forces.nc", "sets.nc")
    )
    parameters = json.loads(sets.attrs["parameters"])
    settings = parameters["settings"]
    paths = [path for path in json.loads(sets.attrs["input_digests"]) if "/filtered/sets/" in path]
    surfaces = [Path(path).parents[3].name for path in paths]  # as in `StorePatterns`
    forces_of_sets = read_master_forces(surfaces, paths, parameters["loading"]).sortby(
        "realization"
    )
    set_count = arguments.sets or sets.sizes["set"]
    master_count = arguments.masters or settings["master_count"]
    sampled_edges = edges_of_sets(forces_of_sets, set_count, master_count, settings)
    claims = read_judged_claims(study / "claims.csv").set_index("id")
    own_ratios = both_ratios(*(filtered_forces[name].mean(CONTACT_AXES) for name in FORCES))
    for name, ratio in own_ratios.items():
        for claim, edge in claimed_edges(filtered_forces, ratio, settings).items():
            set_edges = sampled_edges.loc[name, claim]
            low, median, high = set_edges.quantile([0.025, 0.5, 0.975])
            agree = set_edges.between(*claims.loc[claim, ["accepted_low", "accepted_high"]])
            print(
                f"{name}, {claim}: {edge:.4g} nm; sets: {median:.4g} [{low:.4g}, {high:.4g}] nm, "
                f"{agree.mean():.1%} agree"
            )


if __name__ == "__main__":
    main()
