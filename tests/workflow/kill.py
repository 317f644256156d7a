"""The quick study, killed at random moments and resumed: `python tests/workflow/kill.py`.

Every round starts the study with the same command and kills its whole process group (SIGKILL)
at a random moment: while Snakemake starts, while it builds the graph of jobs, while jobs compute.
The rounds are spread over the study. After the last kill it runs to its end, and all that it made
is compared with an undisturbed run, value by value.
"""

import argparse
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))  # as a script it finds the modules of tests/

from comparison import differences
from repository import QUICK, copy_repository, environment, run_snakemake

from hardcontact.records import dataset
from hardcontact.records.whole_file import PART

#: Guesses, until measured: seconds before the first job, and from one job's end to the next.
START, PACE = 5.0, 0.7
#: Jobs that a round leaves to itself and to each one after it, so that every kill finds a job.
SPARE = 2
END = 60  # seconds in which processes that were killed are gone


class Round:
    """One run of the study in a process group of its own, and how far it is by its output."""

    def __init__(self, study, cores, output):
        self.study, self.output = study, output
        self.begin = time.time()
        self.computing = None  # seconds after which jobs began
        self.done = self.jobs = 0
        command = [sys.executable, "-m", "snakemake", "--configfile", QUICK]
        with open(output, "w") as out:
            self.process = subprocess.Popen(
                command + ([f"--cores={cores}"] if cores else []),
                cwd=study,
                env=environment(study),
                stdout=out,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        self._read = 0  # bytes of the output

    @property
    def seconds(self):
        return time.time() - self.begin

    @property
    def left(self):
        return self.jobs - self.done

    @property
    def stage(self):
        if self.jobs:
            return f"{self.done} of {self.jobs} steps done"
        return "building the graph" if "Building DAG" in self.output.read_text() else "starting"

    def look(self):
        """Read on in the output, as far as its lines are whole."""
        with open(self.output, "rb") as output:
            output.seek(self._read)
            lines = output.read().rpartition(b"\n")[0]
        self._read += len(lines) and len(lines) + 1
        for line in lines.decode().splitlines():
            if total := re.match(r"total +(\d+)$", line):
                self.jobs = int(total[1])
                self.computing = self.seconds
            elif steps := re.match(r"(\d+) of (\d+) steps", line):
                self.done = int(steps[1])

    def wait(self, moment, spare):
        """Wait until `moment` (s), or until no more than `spare` jobs are left."""
        while self.process.poll() is None and self.seconds < moment:
            self.look()
            if self.jobs and self.left <= spare:
                break
            time.sleep(0.02)

    def kill(self):
        """Kill the group; whether the study was running. Waits until all its processes are gone."""
        running = self.process.poll() is None
        if running:
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        if running:
            run_snakemake(self.study, "--unlock")
        end = time.time() + END
        while others := processes(self.study):
            assert time.time() < end, f"outlived the kill: {others}"
            time.sleep(0.02)
        self.look()
        return running

    def finish(self):
        """Let the study run to its end; its exit code."""
        self.process.wait()
        self.look()
        return self.process.returncode


def processes(folder):
    """Command lines of the processes that work in a folder (as far as /proc tells)."""
    commands = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if Path(os.readlink(process / "cwd")) == folder:
                commands.append((process / "cmdline").read_text().replace("\0", " "))
        except OSError:  # of another user, or ended meanwhile
            continue
    return commands


def damaged(results, since):
    """The datasets written after `since` that do not read: none, as they are whole or absent."""
    for path in results.rglob("*.nc"):
        if not path.name.startswith(PART) and path.stat().st_mtime >= since:
            try:
                dataset.read(path)
            except ValueError as error:
                yield str(error)


def leftovers(study, *targets):
    """What must not be where targets are finished: half files, marks of jobs, more to do."""
    yield from (f"{path}: left" for path in (study / "results").rglob(f"{PART}*"))
    marks = (study / ".snakemake/incomplete").rglob("*")
    yield from (f"{path}: left" for path in marks if path.is_file())
    if "Nothing to be done" not in (again := run_snakemake(study, "-n", *targets).stdout):
        yield f"expected nothing to be done again, found: {again[-2000:]}"


def seen(run):
    """What is wrong with what a round printed and wrote."""
    if "Traceback" in run.output.read_text():
        yield f"{run.output.name}: printed a traceback"
    yield from damaged(run.study / "results", run.begin)


def harness(folder, reference, kills, seed, cores=None):
    """Kill the study `kills` times in a new copy in `folder`, finish it, look at what it made.

    reference: study folder of an undisturbed run. Returns what is wrong, a line each.
    """
    folder, results = Path(folder).resolve(), Path(reference, "results")
    study = copy_repository(folder / "killed")
    generator = random.Random(seed)
    begin = time.time()
    start, pace, left = START, PACE, len(list(results.glob("*/benchmarks/**/*.tsv")))
    working, steps, wrong = 0, 0, []
    for to_come in range(kills, 0, -1):
        number = kills - to_come + 1
        run = Round(study, cores, folder / f"round-{number}.log")
        try:
            mean = start + pace * left / (to_come + 1)
            run.wait(generator.uniform(0, 2 * mean), SPARE * (to_come + 1))
        finally:
            seconds, running = run.seconds, run.kill()
        print(f"kill {number}: after {seconds:.1f} s, {run.stage}", flush=True)
        if not running:
            return [f"round {number} ended by itself with {run.process.returncode}"]
        wrong += seen(run)
        steps += run.done
        if run.jobs:
            start, left = run.computing, run.left
            working += seconds - start
            pace = working / steps if steps else pace
    run = Round(study, cores, folder / "last-round.log")
    try:
        code = run.finish()
    finally:
        run.kill()
    print(f"last round: {run.seconds:.0f} s, {run.stage}, exit code {code}")
    print(f"{kills} kills, {steps + run.done} steps, {time.time() - begin:.0f} s")
    wrong += [f"the last round ended with {code}"] if code else []
    wrong += [*seen(run), *leftovers(study)]
    return wrong + differences(study / "results", results)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cores", type=int, help="as the profile says, if not given")
    parser.add_argument("--reference", type=Path, help="study folder of an undisturbed run")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="kill-") as folder:
        reference = chosen.reference
        if reference is None:
            reference = copy_repository(Path(folder, "undisturbed"))
            run = run_snakemake(reference)
            assert run.returncode == 0, run.stdout[-3000:]
        wrong = harness(folder, reference, chosen.kills, chosen.seed, chosen.cores)
    for line in [*wrong, f"{len(wrong)} mismatches"]:
        print(line)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
