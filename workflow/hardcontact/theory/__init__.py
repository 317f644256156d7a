"""Pull-off force and band from a spectrum alone, without a height map, in closed form.

Read `summits` and `closed_form`, then `prediction` (numbers with intervals), `validity` (where the
closed form is validated) and `assumptions` (hard bodies, a small contact area).
"""
