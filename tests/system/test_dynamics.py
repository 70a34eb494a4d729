"""Whose joint figures a run has, as a user asks for them from a shell."""

import pathlib

MODELS = pathlib.Path(__file__).parents[2] / "models"


def printed(understudy, *options):
    done = understudy("run", *options, "--print-config")
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_go2_has_the_fitted_figures_unless_told_otherwise(understudy):
    assert "use: fitted" in printed(understudy, "go2")
    assert "use: catalogue" in printed(understudy, "go2", "--dynamics", "catalogue")


def test_another_model_keeps_its_own_unless_told_otherwise(understudy):
    model = ("--model", MODELS / "go2w" / "go2w.xml")
    assert "use: catalogue" in printed(understudy, "go2", *model)
    for options in ((*model, "--dynamics", "fitted"), ("--dynamics", "fitted", *model)):
        assert "use: fitted" in printed(understudy, "go2", *options)


def test_a_robot_without_a_fit_says_so(understudy):
    done = understudy("run", "h1", "--dynamics", "fitted")
    assert done.returncode == 3
    assert "robot 'h1' has no fitted figures; choose catalogue" in done.stderr


def test_a_word_that_is_neither_is_refused(understudy):
    done = understudy("run", "go2", "--dynamics", "fited")
    assert done.returncode == 3
    assert "did you mean 'fitted'?" in done.stderr
