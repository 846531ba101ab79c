from bbsd.compiler.writing.blocks import Block, Blocks
from bbsd.compiler.writing.precedence import Text, call, infix, name_text
from bbsd.expression.graph import Graph, Level
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
    assert blocks.in_order() == [(first, None, {}), (second, robot, {}), (third, None, {})]
    assert blocks.stage(1) is second


def test_loops_over_pairs_stand_before_the_lanes_of_their_stage():
    blocks = Blocks(Block(Level.CALL), looped=True)
    others, team = blocks.pair(3, others=True), blocks.pair(3, others=False)
    assert blocks.pair(3, others=True) is others
    assert others.level is Level.PAIR
    [stage] = blocks.in_order()
    assert stage == (blocks.stage(3), None, {True: others, False: team})
    assert not stage.is_empty
    assert Blocks(Block(Level.CALL), looped=True).in_order() == []


def test_a_block_holds_statements_that_know_what_they_use():
    block = Block(Level.LANE)
    near = block.define("near", infix("<", name_text("x"), Text("1.0")), Kind.TRUTH)
    block.comment("Store it.")
    block.store("nearby[lane]", call("atan", [near]))
    definition, comment, store = block.statements
    assert block.lines == ["near = x < 1.0", "# Store it.", "nearby[lane] = atan(near)"]
    assert [statement.uses for statement in block.statements] == [{"x"}, frozenset(), {"near"}]
    assert [statement.is_expensive for statement in block.statements] == [False, False, True]
    assert (definition.is_definition, definition.kind, store.is_definition) == (True, Kind.TRUTH, False)
    assert not any(statement.starts_phase for statement in (definition, comment, store))


def test_a_comment_may_start_a_phase():
    block = Block(Level.LANE)
    block.comment("Act.", starts_phase=True)
    assert [statement.starts_phase for statement in block.statements] == [True]


def test_a_block_knows_the_names_of_nodes():
    graph, block = Graph(), Block(Level.LANE)
    own, read, before = (graph.number(value) for value in (1, 2, 3))
    block.define("own", Text("1.0"), node=own)
    block.read_from("read_kept[lane]", "read", read)
    block.define_before("before", Text("3.0"), before)
    assert block.names == {own.number: "own", read.number: "read", before.number: "before"}
    assert block.read == {"read": "read_kept[lane]"}
    assert [statement.line for statement in block.before] == ["before = 3.0"]
    assert block.lines == ["own = 1.0"]
