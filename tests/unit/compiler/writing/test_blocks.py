from bbsd.compiler.writing.blocks import Block, Blocks
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind


def test_stages_are_the_team_s_and_the_robots_in_turn():
    blocks = Blocks(Block(Level.CALL), looped=True)
    assert [blocks.stage(number).level for number in range(4)] == [Level.LANE, Level.EACH] * 2
    straight = Blocks(Block(Level.CALL), looped=False)
    assert straight.stage(0).level is Level.LANE


def test_blocks_come_in_the_order_of_their_stages():
    blocks = Blocks(Block(Level.CALL), looped=True)
    robot = blocks.robot(1)
    third, first, second = blocks.stage(2), blocks.stage(0), blocks.stage(1)
    assert blocks.every() == [(first, None, {}), (second, robot, {}), (third, None, {})]
    assert blocks.stage(1) is second


def test_loops_over_pairs_stand_before_the_lanes_of_their_stage():
    blocks = Blocks(Block(Level.CALL), looped=True)
    others, team = blocks.pair(3, others=True), blocks.pair(3, others=False)
    assert blocks.pair(3, others=True) is others
    assert others.level is Level.PAIR
    [stage] = blocks.every()
    assert stage == (blocks.stage(3), None, {True: others, False: team})
    assert not stage.is_empty
    assert Blocks(Block(Level.CALL), looped=True).every() == []


def test_a_block_knows_what_its_names_hold():
    block = Block(Level.LANE)
    block.assign("near", "x < 1.0", Kind.TRUTH)
    block.assign("x", "1.0")
    assert block.lines == ["near = x < 1.0", "x = 1.0"]
    assert (block.kind_of("near"), block.kind_of("x")) == (Kind.TRUTH, Kind.NUMBER)
