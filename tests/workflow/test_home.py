"""A run by a user without an entry in passwd, whose home takes no files."""

import getpass
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from repository import environment

from snakemake_logger_plugin_stages.home import provide_home

#: The names that Python asks before it asks passwd.
NAMES = ("LOGNAME", "USER", "LNAME", "USERNAME")


def unknown_user(number):
    raise KeyError(f"getpwuid(): uid not found: {number}")


def test_an_unknown_user_gets_a_name_and_a_home(monkeypatch, tmp_path):
    for name in NAMES:
        monkeypatch.setenv(name, "")
    monkeypatch.setattr("pwd.getpwuid", unknown_user)
    monkeypatch.setenv("HOME", str(tmp_path / "missing"))
    provide_home(tmp_path / "given")
    assert getpass.getuser() == str(os.getuid())
    assert Path.home() == tmp_path / "given" and Path.home().is_dir()
    provide_home(tmp_path / "other")
    assert Path.home() == tmp_path / "given"


@pytest.mark.study
@pytest.mark.skipif(
    os.geteuid() != 0 or not shutil.which("setpriv"), reason="only root becomes another user"
)
def test_an_unknown_user_plans_and_predicts(repository):
    """The user may read files of root, as the environment of the tests may be in root's home."""
    user = ["setpriv", "--reuid", "12345", "--regid", "12345", "--clear-groups"]
    user += ["--inh-caps", "+dac_read_search", "--ambient-caps", "+dac_read_search"]
    for path in [repository, *repository.rglob("*")]:
        os.chown(path, 12345, 12345)
    variables = environment(repository) | {"HOME": "/"}
    for name in NAMES:
        variables.pop(name, None)
    run = subprocess.run(
        [*user, sys.executable, "-m", "snakemake", "--quiet", "rules", "-n", "claims"],
        cwd=repository, env=variables, capture_output=True, text=True,
    )  # fmt: skip
    assert run.returncode == 0, run.stdout + run.stderr
    command = "import sys; from hardcontact.commands.command_line import main; sys.exit(main())"
    run = subprocess.run(
        [*user, "env", "-u", "HOME", sys.executable, "-c", command, "predict", "missing.nc"],
        cwd=repository, env=variables, capture_output=True, text=True,
    )  # fmt: skip
    assert run.stderr.splitlines()[-1] == "error: missing.nc: expected a scan, found no such file"
    assert "Traceback" not in run.stderr
