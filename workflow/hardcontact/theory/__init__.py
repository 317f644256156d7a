"""Pull-off force and critical band from a spectrum alone, without a height map, in closed form.

Read `summits`, `closed_form` (the mean force), `pull_off_statistics` (its distribution), then
`prediction` (numbers with intervals) and `validity` (where the closed form holds).
"""
