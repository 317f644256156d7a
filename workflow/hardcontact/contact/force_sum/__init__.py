"""The force sum of Eq. 3 at every contact of an array: begin with `outside_sums`."""
