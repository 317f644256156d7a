"""Edges of the band if mean forces are divided, not the forces of each master.

    python tests/benchmarks/compare_normalizations.py [results/paper] [--sets 3000]

The paper does not say which ratio Fig. 6 shows. The study divides the force on each filtered master
by that on the same master, and takes the mean of these ratios. The other ratio is that of two mean
forces, in which masters with large forces count most. For both, this prints the outermost edges of
the study's own masters, the central 95 % of its sets, and how many sets agree with the paper. The
first sets are those of the study; 3000, in eight minutes, show how the share depends on them.
"""

import argparse
import json
from pathlib import Path

import numpy as np
import xarray as xr

from hardcontact.base.statistics import Sampling
from hardcontact.contact.contact import CONTACT_AXES
from hardcontact.inference.edges_of_masters import edges_of_masters
from hardcontact.inference.forces_on_masters import read_master_forces
from hardcontact.paper.claims.band_quantities import outermost_edge
from hardcontact.paper.claims.verdicts import read_judged_claims
from hardcontact.paper.sets import sample_masters

#: Forces on masters, without and with all roughness.
FORCES = ("pull_off_force", "unfiltered_pull_off_force")


def outermost_edges(filtered_forces, ratio, settings):
    """Return the outermost edges (side) in nm from ratios (surface, realization, ...)."""
    sampling = Sampling(settings["seed"], 0, settings["confidence"])
    ratios = filtered_forces.drop_dims("realization").assign(filtered_force_ratio=ratio)
    edges, _ = edges_of_masters(ratios, settings["tolerance"], sampling)
    return outermost_edge(edges)["value"]


def both_ratios(filtered, unfiltered):
    """Return what is averaged over masters, by the name of the ratio."""
    return {
        "mean of the ratios": filtered / unfiltered,
        "ratio of the means": filtered / unfiltered.mean("realization"),
    }


def main():
    """Print the edges of a finished study by both ratios, for its own masters and its sets."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("study", nargs="?", default="results/paper", type=Path)
    parser.add_argument("--sets", type=int, help="number of sets (default: the study's)")
    arguments = parser.parse_args()
    study = arguments.study
    filtered_forces, sets = (
        xr.load_dataset(study / name) for name in ("filtered_forces.nc", "sets.nc")
    )
    parameters = json.loads(sets.attrs["parameters"])
    settings = parameters["settings"]
    paths = [path for path in json.loads(sets.attrs["input_digests"]) if "/filtered/sets/" in path]
    surfaces = [Path(path).parents[3].name for path in paths]
    set_scales = read_master_forces(surfaces, paths, parameters["loading"]).sortby("realization")
    set_forces = [set_scales[name].mean(CONTACT_AXES) for name in FORCES]
    samples = []
    for set_number in range(1, (arguments.sets or sets.sizes["set"]) + 1):
        sample = (settings["realizations"], settings["seed"], set_number)
        ratios = both_ratios(*(sample_masters(forces, *sample) for forces in set_forces))
        samples.append(
            {name: outermost_edges(set_scales, ratio, settings) for name, ratio in ratios.items()}
        )
    claims = read_judged_claims(study / "claims.csv").set_index("id")
    own_ratios = both_ratios(*(filtered_forces[name].mean(CONTACT_AXES) for name in FORCES))
    for name, ratio in own_ratios.items():
        for edge in outermost_edges(filtered_forces, ratio, settings):
            side = edge["side"].item()
            claim = claims.loc[f"{side}_edge_first"]
            set_edges = np.array([edges[name].sel(side=side).item() for edges in samples])
            low, high = np.percentile(set_edges, [2.5, 97.5])
            agreeing = (claim["accepted_low"] < set_edges) & (set_edges < claim["accepted_high"])
            print(
                f"{name}: {side} edge {edge.item():.4g} [{low:.4g}, {high:.4g}] nm, "
                f"{agreeing.mean():.0%} of the sets agree"
            )


if __name__ == "__main__":
    main()
