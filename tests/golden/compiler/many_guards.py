from bbsd.kernel.functions import add_where, cell_of, clamp_index, divide, floor, maximum_where, select
from bbsd.kernel.memory import as_integers, as_words, part
from bbsd.kernel.streams import fold, uniform, word_of

MEMORY = 640

BY_ROBOT_1 = (0xac39aeacbaa9b617, 0xffb22b91d28bcbe7, 0xff0a25df3a554bbe, 0xb26bdd26cb760ca9, 0xb3c40c665d9246a6, 0xb1922a1339548839, 0x8bfd19a806c68158, 0xea610af1d340b6eb)


def rollout(first, last, numbers, keys, individuals, packed_tables, tables, table_offsets, priorities, constants, returns, credit):
    streams = as_words(numbers)
    cells = as_integers(numbers)
    key = part(streams, 0, 8)
    middle = part(numbers, 8, 8)
    over_1 = part(numbers, 16, 8)
    total = part(numbers, 24, 8)
    credit_wait = part(numbers, 32, 8)
    credit_come = part(numbers, 40, 8)
    credit_nobody = part(numbers, 48, 8)
    running_ = part(numbers, 56, 8)
    over_2 = part(numbers, 64, 8)
    next_middle_kept = part(numbers, 72, 8)
    team_earned = part(numbers, 80, 8)
    over_3 = part(numbers, 88, 8)
    priority_wait = part(cells, 96, 8)
    table_wait = part(cells, 104, 8)
    priority_come = part(cells, 112, 8)
    row_come = part(cells, 120, 8)
    stride = 64
    own_numbers = part(numbers, 128, 512)
    own_cells = as_integers(own_numbers)
    x = part(own_numbers, 0, 512)
    awake = part(own_numbers, 8, 504)
    part_1_kept = part(own_numbers, 16, 496)
    next_x_kept = part(own_numbers, 24, 488)
    next_awake_kept = part(own_numbers, 32, 480)
    cell_come = part(own_cells, 40, 472)
    choice_come = part(own_cells, 48, 464)
    action_kept = part(own_cells, 56, 456)
    reach = constants[0]
    for base in range(first, last, 8):
        for lane in range(8):
            key[lane] = keys[base + lane]
            priority_wait[lane] = priorities[0, base + lane] + 1
            table_wait[lane] = packed_tables[0, individuals[0, base + lane]]
            priority_come[lane] = priorities[1, base + lane]
            row_come[lane] = table_offsets[1] + individuals[1, base + lane] * 80
            total[lane] = 0.0
            credit_wait[lane] = 0.0
            credit_come[lane] = 0.0
            credit_nobody[lane] = 0.0
            running_[lane] = 1.0
        for robot in range(8):
            own = robot * stride
            draw_1 = fold(BY_ROBOT_1[robot], word_of(0))
            for lane in range(8):
                part_1 = uniform(key[lane], draw_1, 0.0, 5.0)
                over_1[lane] = select(robot == 0, part_1, over_1[lane] + part_1)
                part_1_kept[own + lane] = part_1
        for robot in range(8):
            own = robot * stride
            for lane in range(8):
                part_1 = part_1_kept[own + lane]
                x[own + lane] = part_1
                awake[own + lane] = 1.0
        for lane in range(8):
            middle[lane] = over_1[lane] * 0.125
        for step in range(1, 11):
            for robot in range(8):
                own = robot * stride
                for lane in range(8):
                    cell_come[own + lane] = cell_of(abs(x[own + lane] - middle[lane]) < reach) * 40 + clamp_index(floor(x[own + lane]), 39)
                for lane in range(8):
                    choice_come[own + lane] = tables[row_come[lane] + cell_come[own + lane]]
            now_1 = 0.1 * float(step)
            for robot in range(8):
                own = robot * stride
                for lane in range(8):
                    # Decide: the highest layer that is excited and whose cell is not No Action controls.
                    choice_wait = table_wait[lane] & 1
                    choice_come_ = choice_come[own + lane]
                    action = maximum_where(maximum_where(0, choice_wait > 0, priority_wait[lane]), (choice_come_ > 0) & (awake[own + lane] != 0.0), priority_come[lane] + choice_come_) & 65535
                    # Act, then dynamics and sensors.
                    acted_x = select(action == 2, 0.5 * (x[own + lane] + middle[lane]), x[own + lane])
                    next_x = acted_x - now_1
                    next_awake = select(action == 3, False, awake[own + lane] != 0.0)
                    over_2[lane] = select(robot == 0, next_x, over_2[lane] + next_x)
                    part_2 = next_x < 0.0
                    over_3[lane] = select(select(robot == 0, part_2, (over_3[lane] != 0.0) | part_2), 1.0, 0.0)
                    action_kept[own + lane] = action
                    next_x_kept[own + lane] = next_x
                    next_awake_kept[own + lane] = select(next_awake, 1.0, 0.0)
            for lane in range(8):
                next_middle = over_2[lane] * 0.125
                next_middle_kept[lane] = next_middle
            for robot in range(8):
                own = robot * stride
                for lane in range(8):
                    next_x = next_x_kept[own + lane]
                    next_middle = next_middle_kept[lane]
                    action = action_kept[own + lane]
                    # Reward: what each robot earned goes to what controlled it.
                    reward_close = -abs(next_x - next_middle)
                    earned = select(running_[lane] > 0.0, reward_close, 0.0)
                    team_earned[lane] = select(robot == 0, earned, team_earned[lane] + earned)
                    credit_wait[lane] = add_where(credit_wait[lane], action == 1, earned)
                    credit_come[lane] = add_where(credit_come[lane], (action >= 2) & (action < 4), earned)
                    credit_nobody[lane] = add_where(credit_nobody[lane], action == 0, earned)
            for lane in range(8):
                total[lane] = total[lane] + team_earned[lane]
                running_[lane] = select(over_3[lane] != 0.0, 0.0, running_[lane])
            for robot in range(8):
                own = robot * stride
                for lane in range(8):
                    next_x = next_x_kept[own + lane]
                    next_awake = next_awake_kept[own + lane] != 0.0
                    x[own + lane] = next_x
                    awake[own + lane] = select(next_awake, 1.0, 0.0)
            for lane in range(8):
                next_middle = next_middle_kept[lane]
                middle[lane] = next_middle
            if running_.sum() == 0.0:
                break
        for lane in range(8):
            returns[base + lane] = divide(total[lane], 8.0)
            credit[0, base + lane] = divide(credit_wait[lane], 8.0)
            credit[1, base + lane] = divide(credit_come[lane], 8.0)
            credit[2, base + lane] = divide(credit_nobody[lane], 8.0)
