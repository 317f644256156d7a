"""Pull-off force and band from a spectrum alone, without a height map, in closed form.

Read `summits` and `closed_form`, then `validity` (known errors) and `prediction`.
"""
