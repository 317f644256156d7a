"""Claims: the statements of the paper, each with a computed estimate and a verdict.

Read `statements` (resources/paper/claims.csv), `estimates`, one of the modules of quantities,
`selection`, `verdicts`, then `judgement`, which makes the claims.csv of a study.
"""
