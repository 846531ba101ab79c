import numpy as np
import pytest

import bbsd
from bbsd import api
from bbsd.api.given.sources import DICT, TEXT, name_of, run_of, source_of
from bbsd.errors import SpecError, render_text
from bbsd.runs.storage.finished import NoDesign
from tests.unit.architecture.designs import SPECS

SPEC = SPECS.parent / "tests" / "end_to_end" / "specs" / "thermostat.yaml"
QUICK = {"design.coevolution.generations": 2, "design.answer.judged": 200}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A design in a folder."""
    return bbsd.design(SPEC, set=QUICK, out=tmp_path_factory.mktemp("sources") / "run")


@pytest.fixture(scope="module")
def unwritten():
    """A design that is written nowhere."""
    return bbsd.design(SPEC, set=QUICK)


def test_every_form_of_a_design_is_the_same_design(run):
    loaded = bbsd.load(run.folder)
    forms = [run, run.folder, str(run.folder), run.architecture, run.text, loaded.data, loaded]
    assert {bbsd.evaluate(form, episodes=50).mean for form in forms} == {
        bbsd.evaluate(run.architecture, episodes=50).mean
    }
    assert [bbsd.check(form) for form in forms] == [()] * len(forms)


def test_a_design_that_is_written_nowhere_is_the_same(run, unwritten):
    assert unwritten.text == run.text
    assert unwritten.metrics == run.metrics
    assert unwritten.evaluation == run.evaluation
    assert bbsd.explain(unwritten).watched == bbsd.explain(run.folder).watched
    with pytest.raises(api.NotWritten, match="into no folder"):
        _ = unwritten.folder


def test_a_design_that_is_written_nowhere_is_shown(unwritten):
    from bbsd.report.notebook.html import html_of
    from bbsd.report.plain import design_plain
    from bbsd.report.tables import design_table

    assert "thermostat, designed in" in html_of(design_table(unwritten))
    assert design_plain(unwritten, 0, 1)["architecture"] is None


def test_nothing_is_left_of_a_design_that_is_written_nowhere(tmp_path, monkeypatch):
    for folder in ("here", "temporary"):
        (tmp_path / folder).mkdir()
    monkeypatch.chdir(tmp_path / "here")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    bbsd.design(SPEC, set=QUICK)
    assert not [*(tmp_path / "here").iterdir(), *(tmp_path / "temporary").iterdir()]


def test_a_stopped_design_that_is_written_nowhere_has_its_best(tmp_path):
    def stop(_progress):
        raise KeyboardInterrupt

    with pytest.raises(api.Interrupted) as stopped:
        bbsd.design(SPEC, set=QUICK, progress=stop)
    assert stopped.value.best is not None
    assert not api.check(stopped.value.best.text)
    assert stopped.value.written is None


def test_a_design_below_a_folder_is_named_by_the_spec(tmp_path):
    text = SPEC.read_text().replace("name: thermostat", "name: a warm / room")
    found = [bbsd.design(spec, set=QUICK, seed=3, below=tmp_path) for spec in (SPEC, SPEC, text)]
    names = ["thermostat-seed3", "thermostat-seed3-2", "a-warm-room-seed3"]
    assert [each.folder.name for each in found] == names


@pytest.mark.parametrize(("given", "file"), [("text", TEXT), ("dict", DICT)])
def test_a_mistake_in_a_text_or_a_dict_has_a_place(given, file):
    text = SPEC.read_text().replace("structure:", "strukture:").replace("behaviors:", "behavers:")
    spec = text if given == "text" else data_of(text)
    with pytest.raises(SpecError) as refused:
        bbsd.load(spec)
    (diagnosis, *_) = refused.value.diagnoses
    shown = render_text(diagnosis, refused.value.line(diagnosis.place), color=False)
    assert shown.startswith(f"{file}:{diagnosis.place.line}:1: error[BB020]")
    assert "behavers:" in shown


def data_of(text):
    from bbsd.text import Source, read

    return read(Source("any", text)).data


def test_a_dict_may_hold_what_programs_hold():
    data = data_of(SPEC.read_text())
    data["environment"]["steps"] = np.int64(7)
    data["x-places"] = ({"at": np.array([1.5, 2.5])},)
    loaded = bbsd.load(data)
    assert loaded.spec.environment.steps == 7
    assert loaded.data["x-places"] == [{"at": [1.5, 2.5]}]


@pytest.mark.parametrize(
    ("spec", "words"),
    [
        (3, "a spec cannot be given as 3"),
        (None, "a spec cannot be given as a NoneType"),
        (b"spec.yaml", "a spec cannot be given as b'spec.yaml'"),
        ({"environment": {1: 2}}, "a key of a spec is text, not 1, at environment"),
        ({"environment": {"steps": {3}}}, "not a set, at environment.steps"),
    ],
)
def test_what_is_no_spec_is_refused(spec, words):
    with pytest.raises(api.BadArgument, match=words):
        bbsd.load(spec)


def test_a_dict_in_itself_is_refused():
    data = {"name": "loop"}
    data["environment"] = data
    with pytest.raises(api.BadArgument, match="contains itself"):
        bbsd.load(data)


def test_a_text_that_no_file_could_hold_is_refused():
    for text, code in (("name: \ud800\n", "BB003"), ("#" * 1_000_001 + "\n", "BB002")):
        with pytest.raises(SpecError) as refused:
            bbsd.load(text)
        assert [each.code for each in refused.value.diagnoses] == [code]


def test_what_is_set_in_python_is_what_is_set_on_the_command_line():
    texts = ["environment.steps=7", 'design.method="random"', "environment.state.heating=1"]
    by_text = bbsd.load(SPEC, set=texts)
    values = {"environment.steps": 7, "design.method": "random", "environment.state.heating": 1}
    by_dict = bbsd.load(SPEC, set=values)
    assert by_dict.overrides == by_text.overrides
    assert by_dict.spec == by_text.spec


def test_a_spec_that_is_loaded_is_drawn_again_only_by_load():
    loaded = bbsd.load(SPEC, seed=3)
    assert bbsd.load(loaded) is loaded
    assert bbsd.load(loaded, seed=4).meaning.seed == 4


def test_names_and_runs(run, unwritten):
    assert (name_of(run), name_of(unwritten)) == ("run", "thermostat")
    assert name_of(data_of(SPEC.read_text())) == "thermostat"
    assert run_of(run) == run_of(run.folder) == run_of(run.architecture) == run.folder
    assert run_of(unwritten) is run_of(SPEC) is run_of(run.text) is None
    assert source_of(run).file == str(run.architecture)


def test_a_finished_run_is_designed_only_with_a_word_on_it(run):
    with pytest.raises(api.NothingToDesign, match="is the folder of a run that is finished") as refused:
        bbsd.design(run.folder)
    assert "--more N goes on with it" in refused.value.advice
    again = bbsd.design(run, resume=True)
    assert (again.text, again.folder) == (run.text, run.folder)
    with pytest.raises(api.BadArgument, match="was begun with another seed: 0, not 5"):
        bbsd.design(run, resume=True, seed=5)


def test_a_folder_that_is_no_run_is_told(tmp_path):
    with pytest.raises(NoDesign, match="is a folder; design needs the file of one spec"):
        bbsd.design(tmp_path)
