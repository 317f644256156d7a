"""The pull-off forces that a work and a range of adhesion predict."""

from hardcontact.adhesion.predicted_force import Prediction, predicted_force
from hardcontact.records import dataset
from hardcontact.study.job import job

with job(snakemake) as this:
    given = this.parameters
    this.write(
        predicted_force(
            dataset.read(this.input.adhesion),
            Prediction(given["work"], given["rho"], given["sizes"], given["confidence"]),
        ),
        title="predicted pull-off forces",
    )
