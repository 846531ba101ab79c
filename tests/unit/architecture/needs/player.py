"""A robot that decides by what it needs alone, in plain Python, beside a recorded episode."""

from bbsd.architecture.controller import command
from bbsd.architecture.needs import BEFORE
from bbsd.expression.graph import evaluate
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.kernel.streams import DISTRIBUTIONS, fold, word_of


class Robot:
    """One robot: what it keeps, and how many steps it decided."""

    def __init__(self, controller, needs, robot, constants, key):
        self.controller, self.needs, self.robot = controller, needs.robots[robot], robot
        self.given = {
            slot._replace(robot=None if slot.robot is None else robot)
            for each in needs.given
            for slot in each.slots
        }
        self.given |= {slot for each in needs.given if each.of_team for slot in each.slots}
        self.constants, self.key, self.step = constants, key, 0
        self.kept = dict(zip(self.needs.start, self.values(self.needs.start.values(), {}), strict=True))

    def values(self, nodes, known, choice=None):
        def leaf(node, operands):
            match node.operation:
                case "slot":
                    value = known[node.slot]
                    return bool(value) if node.kind is Kind.TRUTH else value
                case "step":
                    return float(self.step)
                case "choice":
                    return choice
                case "draw":
                    word = fold(node.draw.kernel_word, word_of(self.step))
                    return DISTRIBUTIONS[node.draw.distribution](self.key, word, *operands)
            return node.read(self.constants, operands)

        return evaluate(nodes, leaf)

    def act(self, stored):
        """Return the number of the controlling action, and what state is after it, given what is stored."""
        self.step += 1
        known = {slot: stored[slot] for slot in self.given} | self.kept
        if self.step == 1:
            known |= {slot: float("nan") for slot in self.needs.next if slot.name.startswith(BEFORE)}
        cells = [0] * len(self.controller.dimensions)
        for axis, cell in zip(self.needs.cells, self.values(self.needs.cells.values(), known), strict=True):
            cells[axis] = int(cell)
        choice = command(self.controller, cells)
        acted = dict(zip(self.needs.held, self.values(self.needs.held.values(), known), strict=True))
        sets = self.needs.sets.get(choice, {})
        acted |= dict(zip(sets, self.values(sets.values(), known), strict=True))
        after = known | {
            Slot(f"acted {name}", self.robot, place): value for (name, place), value in acted.items()
        }
        self.kept = dict(zip(self.needs.next, self.values(self.needs.next.values(), after), strict=True))
        return choice, acted
