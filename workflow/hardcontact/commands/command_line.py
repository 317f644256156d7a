"""The program `hardcontact`: it carries out the command with which its line begins."""

import os
import sys

from hardcontact.commands.new import new_study
from hardcontact.commands.request import parse_arguments
from hardcontact.config.faults import raise_faults


def main() -> int:
    """Carry out the command line: `new`, `predict`, `verify`, `compare`; return the exit code."""
    try:
        # A terminal would obey control characters, and tables are written in UTF-8.
        raise_faults(
            f"{word!r}: expected printable characters in UTF-8, found others"
            for word in sys.argv[1:]
            if not word.isprintable()
        )
        if sys.argv[1:2] == ["predict"]:
            from hardcontact.commands.predict import predict, predict_arguments

            print(predict(predict_arguments(sys.argv[2:])))
        elif sys.argv[1:2] == ["verify"]:
            from hardcontact.commands.verify import verify, verify_arguments

            words, code = verify(verify_arguments(sys.argv[2:]))
            print(words, flush=True)
            return code
        elif sys.argv[1:2] == ["compare"]:
            from hardcontact.commands.compare import compare, compare_arguments

            print(compare(compare_arguments(sys.argv[2:])))
        else:
            print(new_study(parse_arguments(sys.argv[1:])))
        sys.stdout.flush()
    except BrokenPipeError:  # The reader of the output has ended, such as `head`.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except ValueError as error:
        for line in dict.fromkeys(str(error).splitlines()):
            print(f"error: {line}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("Stopped before anything was written.", file=sys.stderr)
        return 130
    return 0
