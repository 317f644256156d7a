"""What parts mean for the band: numbers and names are those of the datasets."""

import numpy as np
from figure_inputs.closed_form import closed_form
from figure_inputs.elastic_limit import elastic_limit
from figure_inputs.laws import laws
from figure_inputs.maps import maps
from figure_inputs.repeated_contact import repeated_contact
from figure_inputs.scales import band
from figure_inputs.scaling import scaling
from figure_inputs.scan_size import scan_size
from refusals import assert_says

from hardcontact.answer import band_clauses as clauses


def test_edges_that_change_with_a_length_are_counted():
    data = scaling()
    assert clauses.clause_of_scaling(data).endswith("a band of the surface alone.")
    of_ncd = {"surface": "ncd", "part": "all"}
    data["dependence"].loc[{"side": "large", "length": "radius", **of_ncd}] = "undecided"
    assert clauses.clause_of_scaling(data).endswith("to the surface alone is not decided.")
    data["dependence"].loc[{"side": "small", "length": "rho", **of_ncd}] = "partly"
    assert_says(
        clauses.clause_of_scaling(data),
        "√R, √ρ and √(F/H) on 0, 1 and 0 of 4 surfaces, the long edge on 0, 0 and 0: the band does",
    )


def test_a_long_edge_differs_where_intervals_do_not_meet():
    data = scan_size()
    assert "whole surfaces on no surface," in clauses.clause_of_scan_size(data)
    data["long_edge_interval"].loc[{"surface": "uncd", "edge_size": 2500.0}] = [9e3, 27e3]
    said = clauses.clause_of_scan_size(data)
    assert_says(said, "scans of 2.5 µm differs", "whole surfaces on UNCD,", "factors of up to 3.")
    data["long_edge_interval"].loc[{"bound": "high"}] = np.nan
    assert clauses.clause_of_scan_size(data).endswith("but no such interval is closed.")


def test_predicted_edges_are_compared_with_intervals_of_computed_ones():
    predicted, computed = closed_form(), band()
    for surface, edges in (("uncd", [32.0, 1e5]), ("mcd", [1.0, 1860.0])):
        predicted["edge"].loc[{"surface": surface}] = edges
    for surface in ("polished_uncd", "ncd"):
        predicted["edge"].loc[{"surface": surface}] = np.nan
    said = clauses.clause_of_closed_form(predicted, computed)
    assert said.endswith("computed one on UNCD, the long edge on MCD.")


def test_laws_that_move_an_edge_are_named():
    data = laws()
    interval = data["edge_factor_interval"]
    interval.loc[{"bound": "low"}], interval.loc[{"bound": "high"}] = 0.5, 2.0
    assert clauses.clause_of_laws(data).endswith("intervals: none.")
    interval.loc[{"law": "retarded", "side": "small", "group": "pooled"}] = [0.6, 0.9]
    assert clauses.clause_of_laws(data).endswith(": the short edge of retarded (Casimir) alone.")


def test_maps_say_how_many_scans_forces_need():
    data = maps()
    data["scans_needed"].loc[{"rho": 5.6}] = [20.0, 300.0, 40.0, 50.0]
    assert "need 20 to 300 scans to be known within 5 %" in clauses.clause_of_maps(data)
    data["scans_needed"] = data["scans_needed"] * np.nan
    assert "does not tell" in clauses.clause_of_maps(data)


def test_repeated_contact_counts_where_its_interval_leaves_out_one():
    data = repeated_contact()
    assert "on no surface: nothing speaks" in clauses.clause_of_repeated_contact(data)
    data["mean_ratio_interval"].loc[{"surface": "mcd", "preload": 1e-5}] = [1.1, 1.2]
    assert clauses.clause_of_repeated_contact(data).endswith("intervals, on MCD.")


def test_plastic_contact_holds_where_index_and_solved_pressures_say_so():
    data = elastic_limit()
    data["plastic_share"][:], data["solved_plastic_share"][:] = [0, 1, 1, 1], [0, 1, 1, 0.5]
    said = clauses.clause_of_elastic_limit(data)
    assert_says(said, "holds on UNCD and NCD, does not hold on polished UNCD and is not decided")
