"""The model, the configuration and their documentation agree."""

from repository import PAPER, ROOT, leaves

from hardcontact.config import key_tables
from hardcontact.config.model import Study

DOCUMENTATION = (ROOT / "config/README.md").read_text("utf-8")


def test_the_configuration_and_its_documentation_are_made_from_the_model():
    instead = "not current: run python -m hardcontact.config.key_tables"
    assert key_tables.configuration_yaml() == (ROOT / "config/config.yaml").read_text("utf-8"), (
        instead
    )
    assert key_tables.update_columns(DOCUMENTATION) == DOCUMENTATION, instead


def test_the_configuration_of_the_paper_has_every_key_and_its_default():
    assert Study.model_validate(PAPER) == Study()
    assert sorted(leaves(PAPER)) == sorted(leaves(Study().model_dump(warnings=False)))
