"""The next sphere: what is drawn is the dataset, and the page names the best one that counts."""

import numpy as np
from figure_inputs.next_sphere import PRELOADS, RADII, next
from figure_rows import select

from hardcontact.answer.insight_force_facts import next_sphere_facts
from hardcontact.figures import fig_next


def test_table_and_lines_are_those_of_the_dataset():
    data, rows = next(), fig_next.table(next())
    at = {"surface": "ncd", "preload": PRELOADS[1], "radius": RADII[2]}
    drawn = select(rows, quantity="separation", scatter="tests", **at)["value"].item()
    assert drawn == data["separation"].sel(at | {"scatter": "tests"}).item()
    figure = fig_next.draw(data)
    lower = data["separation"].sel(scatter="spheres", preload=PRELOADS[2], surface="mcd").values
    drawn = [np.asarray(line.get_ydata(), float) for line in figure.axes[2].lines]
    assert any(len(line) == len(lower) and np.allclose(line, lower) for line in drawn)


def test_only_spheres_of_a_known_error_are_ranked():
    data = next()
    data["separation"].loc[{"radius": 1e3}] = 50.0
    facts = next_sphere_facts(data)
    found = [row["separation"].low for row in facts["rows"]]
    assert found == sorted(found, reverse=True) and len(found) == 4 * len(PRELOADS)
    assert found[0] == data["separation"].where(data["tried"]).sel(scatter="spheres").max()
    assert facts["decides"] == (found[0] >= facts["right"].value)
