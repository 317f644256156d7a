"""Pull-off force and band from a spectrum alone, without a height map, in closed form.

Read `summits` and `closed_form`, then `prediction` (numbers with intervals). `validity` has
the limits within which the closed form holds.
"""
