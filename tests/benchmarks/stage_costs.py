"""The costs of jobs that the terminal estimates the time left from: costs.tsv of the logger.

    python tests/benchmarks/stage_costs.py quick results/quick results/store-quick
    python tests/benchmarks/stage_costs.py full results/paper results/store
    python tests/benchmarks/stage_costs.py own results/my-coating results/store-my-coating

The last study is of the user's surfaces at full effort, one scan of 512 x 512 pixels.

Each cost is the mean processor time of the jobs of a rule in the benchmarks of a finished study.
"""

import sys
from pathlib import Path

import pandas as pd

from snakemake_logger_plugin_stages.costs import TABLE, name_in_table, read_stages


def job_times(folders, stages):
    """Return the rule in the table and the processor time (s) of every job of a study."""
    paths = [path for folder in folders for path in Path(folder, "benchmarks").rglob("*.tsv")]
    rules = [str(path).partition("benchmarks/")[2].split("/")[0] for path in paths]
    return pd.DataFrame(
        {
            "rule": [name_in_table(rule.removesuffix(".tsv"), stages) for rule in rules],
            "seconds": [pd.read_csv(path, sep="\t").cpu_time[0] for path in paths],
        }
    )


def main():
    """Write the table again, with the costs of the jobs of this study."""
    column, *folders = sys.argv[1:]
    times = job_times(folders, read_stages(column)).groupby("rule").seconds.mean().dropna()
    table = pd.read_csv(TABLE, sep="\t", dtype=str, index_col="rule")
    renewed = times[times.index.intersection(table.index)].map("{:.2g}".format)
    table[column] = renewed.reindex(table.index).fillna(table[column])
    table.to_csv(TABLE, sep="\t")


if __name__ == "__main__":
    main()
