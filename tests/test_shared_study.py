"""The study that test processes share: one run, whether it succeeds or fails."""

import multiprocessing

import pytest
from shared_study import shared_study


def study_in(folder):
    (folder / "study").mkdir()
    (folder / "study/answer").write_text("made once")
    return folder / "study"


def never(folder):
    raise AssertionError("the study ran again")


def failing(folder):
    study_in(folder)
    raise AssertionError("Error in rule prepare_scan")


def outcome(shared, compute, answers):
    """Put what a process gets into a queue: the study's content, or why there is none."""
    try:
        answers.put((shared_study(shared, compute) / "answer").read_text())
    except BaseException as error:
        answers.put(str(error))


def test_a_study_is_computed_once(tmp_path):
    first, second = shared_study(tmp_path, study_in), shared_study(tmp_path, never)
    assert first == second == tmp_path / "study"
    assert (first / "answer").read_text() == "made once"


def test_a_failure_is_told_to_everyone_and_not_repeated(tmp_path):
    with pytest.raises(AssertionError, match="Error in rule prepare_scan"):
        shared_study(tmp_path, failing)
    for _ in range(2):
        with pytest.raises(pytest.fail.Exception, match="Error in rule prepare_scan"):
            shared_study(tmp_path, never)
    assert not (tmp_path / "study").exists()


def test_a_run_that_was_interrupted_is_no_obstacle(tmp_path):
    def interrupted(folder):
        study_in(folder)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        shared_study(tmp_path, interrupted)
    assert (shared_study(tmp_path, study_in) / "answer").read_text() == "made once"


@pytest.mark.parametrize(
    ("compute", "said"), [(study_in, "made once"), (failing, "Error in rule prepare_scan")]
)
def test_processes_at_the_same_time_get_the_same(tmp_path, compute, said):
    context = multiprocessing.get_context("fork")
    answers = context.Queue()
    processes = [context.Process(target=outcome, args=(tmp_path, compute, answers))
                 for _ in range(3)]  # fmt: skip
    for process in processes:
        process.start()
    found = [answers.get(timeout=60) for _ in processes]
    for process in processes:
        process.join()
    assert all(said in one for one in found)
    assert len(list(tmp_path.glob("running-*"))) == 1
