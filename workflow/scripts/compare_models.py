"""Models of others and the closed form beside computed pull-off forces."""

import pandas as pd

from hardcontact.insight.other_models import models_beside_computed
from hardcontact.records.dataset import read
from hardcontact.records.job import job

with job(snakemake) as this:
    designed = pd.read_csv(this.input.validation)
    this.write(
        models_beside_computed(designed, read(this.input.closed_form)),
        title="models of others and the closed form beside computed pull-off forces",
    )
