"""The long edges in the table of scan sizes follow from its force ratios."""

import numpy as np
from validate_scan_sizes import TABLE, TOLERANCE

from hardcontact.base import dataset
from hardcontact.inference.edges import edges_of_ratios


def test_the_edges_of_the_table_follow_from_its_ratios():
    table = dataset.read(TABLE)
    names = ["filtered_force_ratio", "filtered_force_ratio_interval"]
    for name, edge in edges_of_ratios(table[names].assign_coords(side="long"), TOLERANCE).items():
        np.testing.assert_array_equal(table[f"long_{name}"].transpose(*edge.dims), edge)
    assert (table["force_over_largest"].isel(map_size=-1) == 1).all()
