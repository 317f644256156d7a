"""Models of others: the table holds the dataset, the panels what is theirs."""

import numpy as np
from figure_inputs.models import models
from figure_rows import select

from hardcontact.figures import fig_models


def test_table_holds_every_factor_in_the_panel_of_its_model():
    data, rows = models(), fig_models.table(models())
    of_design = select(rows, model="bearing_area_at_summits", design=3)
    assert (
        of_design["value"].item() == data.factor.values[4, 3] and of_design["panel"].item() == "c"
    )
    spread = np.exp(data.force_error.values[3])
    assert np.isclose(of_design["high"].item() / of_design["low"].item(), spread**2)
    coated = select(rows, model="rabinovich", surface="mcd", rho=5.6)
    assert coated["value"].item() == data.surface_factor.values[5, 3, 1]
    assert len(rows) == 6 * (8 + 4 * 2 + 2 * 2)
