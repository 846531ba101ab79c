from bbsd.cli.export import TargetName
from bbsd.exports.exported import Options
from bbsd.exports.targets import TARGETS
from tests.unit.exports.designs import hand_made


def test_the_command_knows_all_targets():
    assert {*TARGETS} == {each.value for each in TargetName}


def test_every_target_carries_the_digest_in_its_main_file():
    exported = hand_made("object_lifting_hand")
    for target in TARGETS.values():
        text = next(iter(target.write(exported, Options()).values()))
        assert exported.controller.digest in text
        assert text.endswith("\n")
