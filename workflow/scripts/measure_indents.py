"""Indents that plastic contact leaves in the sphere: one drawn, the size of all."""

import json

import numpy as np
import pandas as pd
import xarray as xr

from hardcontact import contact, dataset, log, patches, sphere

log.start(snakemake.log[0])
parameters = json.loads(snakemake.params.canonical)
settings, preloads, radius = parameters["contact"], parameters["preloads"], parameters["radius"]
published = pd.read_csv(snakemake.input.published).set_index("quantity").value
keys = [tuple(key) for key in parameters["pairs"]]


def read_pair(substrate, rough):
    return sphere.pair(
        dataset.read(substrate), dataset.read(rough), settings["window"], settings["count"]
    )


def lowest(pair):
    """Touching pixels of all contacts at the largest preload, and how many touch at each."""
    counts = [
        contact.contact_pixel_count(preload, settings["hardness"], pair.pixel_size)
        for preload in preloads
    ]
    geometry = pair.pixel_size, radius, pair.window
    return counts, contact.all_lowest_gaps(
        pair.substrate, pair.positions, *geometry, max(counts), pair.roughness
    )


def measured(pair):
    """Indents (preload, contact_y, contact_x) of one pair of scans."""
    counts, contacts = lowest(pair)
    indents = np.array(
        [
            [
                patches.indents(gaps[:count], offsets[:count], pair.pixel_size)
                for gaps, offsets in contacts.values()
            ]
            for count in counts
        ]
    ).reshape(len(counts), settings["count"], settings["count"], -1)
    dimensions = ("preload", "contact_y", "contact_x")
    return xr.Dataset(
        {
            name: (dimensions, indents[..., k], {"units": unit})
            for k, (name, unit) in enumerate(
                (("depth", "nm"), ("edge_length", "nm"), ("lateral_size", "nm"), ("indents", "1"))
            )
        }
    )


paths = list(zip(snakemake.input.substrates, snakemake.input.spheres, strict=True))
sizes = dataset.stack(
    {
        key: measured(read_pair(*pair))
        for key, pair in log.progress(zip(keys, paths, strict=True), len(keys), "pairs of scans")
    },
    ["scan", "sphere_scan"],
).assign_coords(preload=("preload", preloads, {"units": "N"}))

# The contact drawn: the one whose depth at the largest preload is the median.
deepest = sizes.depth.sel(preload=max(preloads))
deepest = deepest.stack(each=["scan", "sphere_scan", "contact_y", "contact_x"]).dropna("each")
*key, i, j = deepest.each.values[np.argsort(deepest.values)[deepest.size // 2]]
pair = read_pair(*paths[keys.index(tuple(key))])
counts, contacts = lowest(pair)
gaps, offsets = contacts[int(i), int(j)]
reach = 32
drawn = [patches.flattening(gaps[:count], offsets[:count], reach) for count in counts]

position = np.arange(-reach, reach + 1) * pair.pixel_size
axis = {"units": "nm", "long_name": "position from the deepest point"}
dataset.write(
    sizes.assign(
        indentation=(
            ("preload", "y", "x"),
            drawn,
            {"units": "nm", "long_name": "flattening of the sphere"},
        ),
        sphere_height=(
            ("y", "x"),
            sphere.rough_sphere(pair, radius, offsets[0], reach),
            {"units": "nm", "long_name": "undeformed sphere, up from its apex"},
        ),
    )
    .assign_coords(y=("y", position, axis), x=("x", position, axis))
    .assign_attrs(
        surface=parameters["surface"],
        label=parameters["label"],
        basis=parameters["basis"],
        hardness=settings["hardness"],
        sphere_radius=radius,
        published_depth=published["indent_depth"],
        published_edge_length=published["indent_edge_length"],
        published_preload=published["preload_indentation"],
    ),
    snakemake.output[0],
    title=f"indents left in the sphere by contacts on {parameters['label']}",
    parameters=snakemake.params.canonical,
    inputs=snakemake.input,
    code=snakemake.input.code,
)
