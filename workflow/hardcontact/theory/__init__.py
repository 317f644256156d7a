"""Pull-off force and band from a spectrum alone, without a height map, in closed form.

Read `summits` and `closed_form`, then `prediction` (numbers with intervals). `validity` has
the inputs for which the errors of the closed form are known.
"""
