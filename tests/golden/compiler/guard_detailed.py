from bbsd.kernel.functions import add_where, cell_of, clamp_index, divide, floor, is_finite, maximum_where, select
from bbsd.kernel.memory import as_integers, as_words, part
from bbsd.kernel.streams import fold, uniform, word_of

MEMORY = 232


def rollout_detailed(first, last, numbers, keys, individuals, packed_tables, tables, table_offsets, priorities, constants, returns, credit, terms, control, steps_taken, not_finite, expectations_met):
    streams = as_words(numbers)
    cells = as_integers(numbers)
    key = part(streams, 0, 8)
    x_0 = part(numbers, 8, 8)
    x_1 = part(numbers, 16, 8)
    awake_0 = part(numbers, 24, 8)
    awake_1 = part(numbers, 32, 8)
    middle_0 = part(numbers, 40, 8)
    sum_close = part(numbers, 48, 8)
    steps_wait = part(numbers, 56, 8)
    steps_come = part(numbers, 64, 8)
    steps_nobody = part(numbers, 72, 8)
    steps_taken_ = part(numbers, 80, 8)
    total = part(numbers, 88, 8)
    credit_wait = part(numbers, 96, 8)
    credit_come = part(numbers, 104, 8)
    credit_nobody = part(numbers, 112, 8)
    not_finite_x_0 = part(numbers, 120, 8)
    not_finite_x_1 = part(numbers, 128, 8)
    not_finite_middle_0 = part(numbers, 136, 8)
    not_finite_middle_1 = part(numbers, 144, 8)
    undecided = part(numbers, 152, 8)
    running_ = part(numbers, 160, 8)
    priority_wait = part(cells, 168, 8)
    table_wait = part(cells, 176, 8)
    priority_come = part(cells, 184, 8)
    row_come = part(cells, 192, 8)
    cell_come_0 = part(cells, 200, 8)
    choice_come_0 = part(cells, 208, 8)
    cell_come_1 = part(cells, 216, 8)
    choice_come_1 = part(cells, 224, 8)
    reach = constants[0]
    for base in range(first, last, 8):
        draw_1 = fold(0xac39aeacbaa9b617, word_of(0))
        draw_2 = fold(0xffb22b91d28bcbe7, word_of(0))
        for lane in range(8):
            key[lane] = keys[base + lane]
            priority_wait[lane] = priorities[0, base + lane] + 1
            table_wait[lane] = packed_tables[0, individuals[0, base + lane]]
            priority_come[lane] = priorities[1, base + lane]
            row_come[lane] = table_offsets[1] + individuals[1, base + lane] * 80
            part_1 = uniform(key[lane], draw_1, 0.0, 5.0)
            part_2 = uniform(key[lane], draw_2, 0.0, 5.0)
            x_0[lane] = part_1
            x_1[lane] = part_2
            awake_0[lane] = 1.0
            awake_1[lane] = 1.0
            middle_0[lane] = (part_1 + part_2) * 0.5
            total[lane] = 0.0
            credit_wait[lane] = 0.0
            credit_come[lane] = 0.0
            credit_nobody[lane] = 0.0
            sum_close[lane] = 0.0
            steps_wait[lane] = 0.0
            steps_come[lane] = 0.0
            steps_nobody[lane] = 0.0
            steps_taken_[lane] = 0.0
            not_finite_x_0[lane] = 0.0
            not_finite_x_1[lane] = 0.0
            not_finite_middle_0[lane] = 0.0
            not_finite_middle_1[lane] = 0.0
            undecided[lane] = 0.0
            running_[lane] = 1.0
        for step in range(1, 11):
            for lane in range(8):
                cell_come_0[lane] = cell_of(abs(x_0[lane] - middle_0[lane]) < reach) * 40 + clamp_index(floor(x_0[lane]), 39)
                cell_come_1[lane] = cell_of(abs(x_1[lane] - middle_0[lane]) < reach) * 40 + clamp_index(floor(x_1[lane]), 39)
            for lane in range(8):
                choice_come_0[lane] = tables[row_come[lane] + cell_come_0[lane]]
                choice_come_1[lane] = tables[row_come[lane] + cell_come_1[lane]]
            now_1 = 0.1 * float(step)
            for lane in range(8):
                # Decide: the highest layer that is excited and whose cell is not No Action controls.
                choice_wait_0 = table_wait[lane] & 1
                choice_come_0_ = choice_come_0[lane]
                action_0 = maximum_where(maximum_where(0, choice_wait_0 > 0, priority_wait[lane]), (choice_come_0_ > 0) & (awake_0[lane] != 0.0), priority_come[lane] + choice_come_0_) & 65535
                choice_wait_1 = table_wait[lane] & 1
                choice_come_1_ = choice_come_1[lane]
                action_1 = maximum_where(maximum_where(0, choice_wait_1 > 0, priority_wait[lane]), (choice_come_1_ > 0) & (awake_1[lane] != 0.0), priority_come[lane] + choice_come_1_) & 65535
                # Act, then dynamics and sensors.
                acted_x_0 = select(action_0 == 2, 0.5 * (x_0[lane] + middle_0[lane]), x_0[lane])
                next_x_0 = acted_x_0 - now_1
                acted_x_1 = select(action_1 == 2, 0.5 * (x_1[lane] + middle_0[lane]), x_1[lane])
                next_x_1 = acted_x_1 - now_1
                next_awake_0 = select(action_0 == 3, False, awake_0[lane] != 0.0)
                next_awake_1 = select(action_1 == 3, False, awake_1[lane] != 0.0)
                next_middle_0 = (next_x_0 + next_x_1) * 0.5
                # Reward: what each robot earned goes to what controlled it.
                reward_close_0 = -abs(next_x_0 - next_middle_0)
                earned_0 = select(running_[lane] > 0.0, reward_close_0, 0.0)
                reward_close_1 = -abs(next_x_1 - next_middle_0)
                earned_1 = select(running_[lane] > 0.0, reward_close_1, 0.0)
                total[lane] = total[lane] + (earned_0 + earned_1)
                credit_wait[lane] = add_where(add_where(credit_wait[lane], action_0 == 1, earned_0), action_1 == 1, earned_1)
                credit_come[lane] = add_where(add_where(credit_come[lane], (action_0 >= 2) & (action_0 < 4), earned_0), (action_1 >= 2) & (action_1 < 4), earned_1)
                credit_nobody[lane] = add_where(add_where(credit_nobody[lane], action_0 == 0, earned_0), action_1 == 0, earned_1)
                # What an evaluation adds up.
                sum_close[lane] = sum_close[lane] + select(running_[lane] > 0.0, reward_close_0, 0.0) + select(running_[lane] > 0.0, reward_close_1, 0.0)
                steps_wait[lane] = steps_wait[lane] + select(action_0 == 1, running_[lane], 0.0) + select(action_1 == 1, running_[lane], 0.0)
                steps_come[lane] = steps_come[lane] + select((action_0 >= 2) & (action_0 < 4), running_[lane], 0.0) + select((action_1 >= 2) & (action_1 < 4), running_[lane], 0.0)
                steps_nobody[lane] = steps_nobody[lane] + select(action_0 == 0, running_[lane], 0.0) + select(action_1 == 0, running_[lane], 0.0)
                not_finite_x_0[lane] = not_finite_x_0[lane] + select(is_finite(next_x_0), 0.0, running_[lane])
                not_finite_x_1[lane] = not_finite_x_1[lane] + select(is_finite(next_x_1), 0.0, running_[lane])
                not_finite_middle_0[lane] = not_finite_middle_0[lane] + select(is_finite(next_middle_0), 0.0, running_[lane])
                not_finite_middle_1[lane] = not_finite_middle_1[lane] + select(is_finite(next_middle_0), 0.0, running_[lane])
                decided_1 = is_finite(abs(x_0[lane] - middle_0[lane])) & is_finite(abs(x_1[lane] - middle_0[lane]))
                undecided[lane] = undecided[lane] + select(decided_1, 0.0, running_[lane])
                steps_taken_[lane] = steps_taken_[lane] + running_[lane]
                running_[lane] = select((next_x_0 < 0.0) | (next_x_1 < 0.0), 0.0, running_[lane])
                x_0[lane] = next_x_0
                x_1[lane] = next_x_1
                awake_0[lane] = select(next_awake_0, 1.0, 0.0)
                awake_1[lane] = select(next_awake_1, 1.0, 0.0)
                middle_0[lane] = next_middle_0
            if running_.sum() == 0.0:
                break
        for lane in range(8):
            returns[base + lane] = divide(total[lane], 2.0)
            credit[0, base + lane] = divide(credit_wait[lane], 2.0)
            credit[1, base + lane] = divide(credit_come[lane], 2.0)
            credit[2, base + lane] = divide(credit_nobody[lane], 2.0)
            terms[0, base + lane] = divide(sum_close[lane], 2.0)
            control[0, base + lane] = steps_wait[lane]
            control[1, base + lane] = steps_come[lane]
            control[2, base + lane] = steps_nobody[lane]
            steps_taken[base + lane] = steps_taken_[lane]
            not_finite[0, base + lane] = not_finite_x_0[lane]
            not_finite[1, base + lane] = not_finite_x_1[lane]
            not_finite[2, base + lane] = not_finite_middle_0[lane]
            not_finite[3, base + lane] = not_finite_middle_1[lane]
            not_finite[4, base + lane] = undecided[lane]
