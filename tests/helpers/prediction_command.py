"""The command `hardcontact predict`: its words and its numbers."""

import json

from hardcontact.commands.predict import predict, predict_arguments


def predict_text(*arguments):
    return predict(predict_arguments(arguments))


def predict_json(*arguments):
    """Return the JSON output of the command."""
    return json.loads(predict_text(*arguments, "--json", "-"))
