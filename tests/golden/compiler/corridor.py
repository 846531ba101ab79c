from bbsd.kernel.functions import add_where, cell_of, divide, maximum_where, select
from bbsd.kernel.memory import as_integers, as_words, part

MEMORY = 144


def rollout_start(base, step, numbers, keys, individuals, packed_tables, tables, table_offsets, priorities, constants, returns, credit, outside, sent, chosen, living):
    streams = as_words(numbers)
    cells = as_integers(numbers)
    key = part(streams, 0, 8)
    command_0 = part(numbers, 8, 8)
    command_1 = part(numbers, 16, 8)
    work_0 = part(numbers, 24, 8)
    work_1 = part(numbers, 32, 8)
    tired_0 = part(numbers, 40, 8)
    tired_1 = part(numbers, 48, 8)
    total = part(numbers, 56, 8)
    credit_go_left = part(numbers, 64, 8)
    credit_go_right = part(numbers, 72, 8)
    credit_nobody = part(numbers, 80, 8)
    running_ = part(numbers, 88, 8)
    charger_0 = part(cells, 96, 8)
    charger_1 = part(cells, 104, 8)
    priority_go_left = part(cells, 112, 8)
    table_go_left = part(cells, 120, 8)
    priority_go_right = part(cells, 128, 8)
    table_go_right = part(cells, 136, 8)
    for lane in range(8):
        key[lane] = keys[base + lane]
        priority_go_left[lane] = priorities[0, base + lane]
        table_go_left[lane] = packed_tables[0, individuals[0, base + lane]]
        priority_go_right[lane] = priorities[1, base + lane] + 1
        table_go_right[lane] = packed_tables[1, individuals[1, base + lane]]
        part_1 = outside[0, lane]
        part_2 = outside[1, lane]
        command_0[lane] = 0.0
        command_1[lane] = 0.0
        work_0[lane] = 0.0
        work_1[lane] = 0.0
        charger_0[lane] = select(part_1 > 7.0, 0, select(part_1 == 7.0, 1, 2))
        charger_1[lane] = select(part_2 > 7.0, 0, select(part_2 == 7.0, 1, 2))
        tired_0[lane] = 0.0
        tired_1[lane] = 0.0
        total[lane] = 0.0
        credit_go_left[lane] = 0.0
        credit_go_right[lane] = 0.0
        credit_nobody[lane] = 0.0
        running_[lane] = 1.0


def rollout_decide(base, step, numbers, keys, individuals, packed_tables, tables, table_offsets, priorities, constants, returns, credit, outside, sent, chosen, living):
    cells = as_integers(numbers)
    command_0 = part(numbers, 8, 8)
    command_1 = part(numbers, 16, 8)
    tired_0 = part(numbers, 40, 8)
    tired_1 = part(numbers, 48, 8)
    charger_0 = part(cells, 96, 8)
    charger_1 = part(cells, 104, 8)
    priority_go_left = part(cells, 112, 8)
    table_go_left = part(cells, 120, 8)
    priority_go_right = part(cells, 128, 8)
    table_go_right = part(cells, 136, 8)
    for lane in range(8):
        # Decide: the highest layer that is excited and whose cell is not No Action controls.
        choice_go_left_0 = (table_go_left[lane] >> (charger_0[lane] * 2)) & 3
        choice_go_right_0 = (table_go_right[lane] >> (charger_0[lane] * 2 + cell_of(tired_0[lane] != 0.0))) & 1
        action_0 = maximum_where(maximum_where(0, choice_go_left_0 > 0, priority_go_left[lane] + choice_go_left_0), choice_go_right_0 > 0, priority_go_right[lane]) & 65535
        choice_go_left_1 = (table_go_left[lane] >> (charger_1[lane] * 2)) & 3
        choice_go_right_1 = (table_go_right[lane] >> (charger_1[lane] * 2 + cell_of(tired_1[lane] != 0.0))) & 1
        action_1 = maximum_where(maximum_where(0, choice_go_left_1 > 0, priority_go_left[lane] + choice_go_left_1), choice_go_right_1 > 0, priority_go_right[lane]) & 65535
        chosen[0, lane] = action_0
        chosen[1, lane] = action_1
        next_command_0 = select(action_0 == 3, 1.0, select(action_0 == 2, -2.0, select(action_0 == 1, -1.0, command_0[lane])))
        sent[0, lane] = next_command_0
        next_command_1 = select(action_1 == 3, 1.0, select(action_1 == 2, -2.0, select(action_1 == 1, -1.0, command_1[lane])))
        sent[1, lane] = next_command_1


def rollout_outcome(base, step, numbers, keys, individuals, packed_tables, tables, table_offsets, priorities, constants, returns, credit, outside, sent, chosen, living):
    cells = as_integers(numbers)
    command_0 = part(numbers, 8, 8)
    command_1 = part(numbers, 16, 8)
    work_0 = part(numbers, 24, 8)
    work_1 = part(numbers, 32, 8)
    tired_0 = part(numbers, 40, 8)
    tired_1 = part(numbers, 48, 8)
    total = part(numbers, 56, 8)
    credit_go_left = part(numbers, 64, 8)
    credit_go_right = part(numbers, 72, 8)
    credit_nobody = part(numbers, 80, 8)
    running_ = part(numbers, 88, 8)
    charger_0 = part(cells, 96, 8)
    charger_1 = part(cells, 104, 8)
    for lane in range(8):
        action_0 = chosen[0, lane]
        action_1 = chosen[1, lane]
        # Act, then dynamics and sensors.
        next_command_0 = select(action_0 == 3, 1.0, select(action_0 == 2, -2.0, select(action_0 == 1, -1.0, command_0[lane])))
        next_command_1 = select(action_1 == 3, 1.0, select(action_1 == 2, -2.0, select(action_1 == 1, -1.0, command_1[lane])))
        part_1 = abs(next_command_0)
        next_work_0 = work_0[lane] + part_1
        part_2 = abs(next_command_1)
        next_work_1 = work_1[lane] + part_2
        next_place_0 = outside[0, lane]
        next_charger_0 = select(next_place_0 > 7.0, 0, select(next_place_0 == 7.0, 1, 2))
        next_place_1 = outside[1, lane]
        next_charger_1 = select(next_place_1 > 7.0, 0, select(next_place_1 == 7.0, 1, 2))
        next_tired_0 = next_work_0 > 5.0
        next_tired_1 = next_work_1 > 5.0
        # Reward: what each robot earned goes to what controlled it.
        reward_there_0 = outside[2, lane]
        reward_effort_0 = -0.1 * part_1
        earned_0 = select(running_[lane] > 0.0, reward_there_0 + reward_effort_0, 0.0)
        reward_there_1 = outside[3, lane]
        reward_effort_1 = -0.1 * part_2
        earned_1 = select(running_[lane] > 0.0, reward_there_1 + reward_effort_1, 0.0)
        total[lane] = total[lane] + (earned_0 + earned_1)
        credit_go_left[lane] = add_where(add_where(credit_go_left[lane], (action_0 >= 1) & (action_0 < 3), earned_0), (action_1 >= 1) & (action_1 < 3), earned_1)
        credit_go_right[lane] = add_where(add_where(credit_go_right[lane], action_0 == 3, earned_0), action_1 == 3, earned_1)
        credit_nobody[lane] = add_where(add_where(credit_nobody[lane], action_0 == 0, earned_0), action_1 == 0, earned_1)
        running_[lane] = select(outside[4, lane] != 0.0, 0.0, running_[lane])
        command_0[lane] = next_command_0
        command_1[lane] = next_command_1
        work_0[lane] = next_work_0
        work_1[lane] = next_work_1
        charger_0[lane] = next_charger_0
        charger_1[lane] = next_charger_1
        tired_0[lane] = select(next_tired_0, 1.0, 0.0)
        tired_1[lane] = select(next_tired_1, 1.0, 0.0)
    for lane in range(8):
        living[lane] = running_[lane]


def rollout_finish(base, step, numbers, keys, individuals, packed_tables, tables, table_offsets, priorities, constants, returns, credit, outside, sent, chosen, living):
    total = part(numbers, 56, 8)
    credit_go_left = part(numbers, 64, 8)
    credit_go_right = part(numbers, 72, 8)
    credit_nobody = part(numbers, 80, 8)
    for lane in range(8):
        returns[base + lane] = divide(total[lane], 2.0)
        credit[0, base + lane] = divide(credit_go_left[lane], 2.0)
        credit[1, base + lane] = divide(credit_go_right[lane], 2.0)
        credit[2, base + lane] = divide(credit_nobody[lane], 2.0)
