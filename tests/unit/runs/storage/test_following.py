from bbsd.runs.storage.following import Follower


def test_only_whole_lines_that_are_new_are_read(tmp_path):
    path = tmp_path / "metrics.jsonl"
    path.write_text('{"generation": 1}\n')
    follower = Follower(path)
    assert list(follower.new_lines()) == []
    with path.open("a") as file:
        file.write('{"generation": 2}\n{"gener')
        file.flush()
        assert list(follower.new_lines()) == [{"generation": 2}]
        file.write('ation": 3}\n')
    assert list(follower.new_lines()) == [{"generation": 3}]
    assert list(follower.new_lines()) == []


def test_a_file_may_come_later(tmp_path):
    follower = Follower(tmp_path / "run-2" / "metrics.jsonl")
    assert list(follower.new_lines()) == []
    (tmp_path / "run-2").mkdir()
    (tmp_path / "run-2" / "metrics.jsonl").write_text('{"generation": 1}\n')
    assert list(follower.new_lines()) == [{"generation": 1}]
