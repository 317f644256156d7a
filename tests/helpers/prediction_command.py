"""The command `hardcontact predict`: its words and its numbers."""

import json

from hardcontact.commands.predict import predict, predict_arguments
from hardcontact.surfaces.spectrum import smooth_rolloff


def printed(*arguments):
    return predict(predict_arguments(arguments))


def rolled_off(wavevector):
    """C_iso of a self-affine surface with a roll-off at 1 µm."""
    return smooth_rolloff(wavevector, 1e6, 1000.0, 0.8)


def numbers_of(*arguments):
    """Return the JSON output of the command."""
    return json.loads(printed(*arguments, "--json", "-"))
