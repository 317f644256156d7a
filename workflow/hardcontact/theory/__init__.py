"""Pull-off force and band from a spectrum alone, without a height map, in closed form.

Read `summits` and `closed_form`, then `prediction` (numbers with intervals). `validity` says where
the closed form is validated, `assumptions` what it assumes of a contact: hard bodies, a small area.
"""
