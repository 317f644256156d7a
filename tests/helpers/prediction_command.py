"""The command `hardcontact predict`: its words and its numbers."""

import json

from hardcontact.commands.predict import predict, predict_arguments


def printed(*arguments):
    return predict(predict_arguments(arguments))


def numbers_of(*arguments):
    """Return the JSON output of the command."""
    return json.loads(printed(*arguments, "--json", "-"))
