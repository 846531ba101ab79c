/* The lifting task with explicit vectors, a lane an agent, and bbsd's arctangent.
   Each phase of a step is done for several vectors before the next: short loops, so that the processor works on
   one vector while it waits for another. */
#include <math.h>
#include "vectors.h"

enum { STEPS = 300, ROBOTS = 3, BEHAVIORS = 5, CELLS = 6, VECTORS = 5, BATCH = VECTORS * WIDTH };
enum { PUSH_MORE, DO_NOT_GO_FAST, STOP_AT_GOAL, HURRY_UP, SLOW_DOWN, NOBODY };

#define SPEED_STEP ALL(1)
#define TOP_SPEED ALL(5)
#define GOAL ALL(3)
#define SMALL_TILT ALL(5)
#define ZERO ALL(0)

typedef struct {
    Numbers height[ROBOTS], speed[ROBOTS], tilt, total, credit[BEHAVIORS + 1];
    Numbers slope, before;
    Words table[BEHAVIORS], priority[BEHAVIORS], action[ROBOTS];
} Lanes;

/* The same in memory, one number for each lane of a vector. */
typedef struct {
    double height[ROBOTS][WIDTH], total[WIDTH], credit[BEHAVIORS + 1][WIDTH];
    int64_t table[BEHAVIORS][WIDTH], priority[BEHAVIORS][WIDTH];
} Rows;

/* bbsd/kernel/angles.py, operation by operation, for x >= 0. */
static inline Numbers arctangent(Numbers x) {
    Truths flat = AT_MOST(x, ALL(0.41421356237309503)), steep = BELOW(ALL(2.414213562373095), x);
    Numbers above = PICK(flat, x, PICK(steep, ALL(-1), x - ALL(1)));
    Numbers below = PICK(flat, ALL(1), PICK(steep, x, x + ALL(1)));
    Numbers base = PICK(flat, ZERO, PICK(steep, ALL(1.5707963267948966), ALL(0.7853981633974483)));
    Numbers rest = PICK(flat, ZERO, PICK(steep, ALL(6.123233995736766e-17), ALL(3.061616997868383e-17)));
    Numbers t = above / below, z = t * t;
    Numbers p = ALL(-0.05038975330045011) + z * (ALL(0.03805655938015656) + z * ALL(-0.017898809046130823));
    p = ALL(-0.06663092950455685) + z * (ALL(0.05847812614151057) + z * p);
    p = ALL(-0.09090897696109673) + z * (ALL(0.07692059182472918) + z * p);
    p = ALL(-0.1428571428014781) + z * (ALL(0.1111111078117738) + z * p);
    p = ALL(-0.333333333333332) + z * (ALL(0.1999999999995307) + z * p);
    return base + (t + (t * (z * p) + rest));
}

static inline Numbers slope_of(const Numbers *height) {
    Numbers sideways = (height[2] - height[1]) / ALL(sqrt(3));
    Numbers forward = (height[0] - (height[1] + height[2]) * ALL(0.5)) / ALL(1.5);
    return ROOT(sideways * sideways + forward * forward);
}

static inline void sense(Lanes *lanes) {
    lanes->before = lanes->tilt;
    lanes->tilt = arctangent(lanes->slope) * ALL(57.29577951308232);
}

/* The highest priority among the activated behaviors; its lowest bits are the behavior's number and one. */
static inline Words action_of(const Lanes *lanes, int robot, Words tilted, Numbers lowest, Numbers highest) {
    Numbers height = lanes->height[robot], speed = lanes->speed[robot];
    Words place = WORD(EQUAL(height, lowest), WHOLE(0), WORD(EQUAL(height, highest), WHOLE(2), WHOLE(4)));
    Words cell = PLUS(place, tilted), pace = TRUNCATED(GREATER(LESSER(speed, ALL(5)), ZERO));
    Words reached = WORD(AT_MOST(GOAL, height), WHOLE(1), WHOLE(0)), best = WHOLE(0);
    best = RAISED(best, ODD(lanes->table[PUSH_MORE]), lanes->priority[PUSH_MORE]);
    best = RAISED(best, ODD(SHIFTED(lanes->table[DO_NOT_GO_FAST], pace)), lanes->priority[DO_NOT_GO_FAST]);
    best = RAISED(best, ODD(SHIFTED(lanes->table[STOP_AT_GOAL], reached)), lanes->priority[STOP_AT_GOAL]);
    best = RAISED(best, ODD(SHIFTED(lanes->table[HURRY_UP], cell)), lanes->priority[HURRY_UP]);
    best = RAISED(best, ODD(SHIFTED(lanes->table[SLOW_DOWN], cell)), lanes->priority[SLOW_DOWN]);
    return BOTH_BITS(best, WHOLE(7));
}

static inline void decide(Lanes *lanes) {
    const Numbers *height = lanes->height;
    Numbers lowest = LESSER(LESSER(height[0], height[1]), height[2]);
    Numbers highest = GREATER(GREATER(height[0], height[1]), height[2]);
    Words tilted = WORD(BELOW(SMALL_TILT, lanes->tilt), WHOLE(1), WHOLE(0));
    for (int robot = 0; robot < ROBOTS; robot++)
        lanes->action[robot] = action_of(lanes, robot, tilted, lowest, highest);
}

static inline Truths controls(const Lanes *lanes, int robot, int behavior) {
    return SAME(lanes->action[robot], WHOLE(behavior == NOBODY ? 0 : behavior + 1));
}

static inline void act(Lanes *lanes) {
    for (int robot = 0; robot < ROBOTS; robot++) {
        Numbers speed = lanes->speed[robot], more = speed + SPEED_STEP;
        Numbers next = PICK(controls(lanes, robot, PUSH_MORE), more, speed);
        next = PICK(controls(lanes, robot, DO_NOT_GO_FAST), LESSER(speed, TOP_SPEED), next);
        next = PICK(controls(lanes, robot, STOP_AT_GOAL), ZERO, next);
        next = PICK(controls(lanes, robot, HURRY_UP), LESSER(more, TOP_SPEED), next);
        next = PICK(controls(lanes, robot, SLOW_DOWN), GREATER(speed - SPEED_STEP, ZERO), next);
        lanes->speed[robot] = next;
        lanes->height[robot] += next * ALL(0.005);
    }
    lanes->slope = slope_of(lanes->height);
}

static inline Numbers earned_by(Numbers height, Numbers speed, Numbers together) {
    Numbers earned = together + PICK(BELOW(SIZE(height - GOAL), ALL(0.5)), ALL(1), ALL(-0.1));
    earned += PICK(BELOW(ALL(3.0 + 0.2), height), ALL(-1), ZERO);
    return earned + PICK(BELOW(TOP_SPEED, SIZE(speed)), ALL(-0.1), ZERO);
}

static inline void reward(Lanes *lanes, Numbers root) {
    Numbers earned[ROBOTS];
    Numbers leveling = PICK(BELOW(lanes->tilt - lanes->before, ALL(-0.5)), ALL(1), ALL(-0.1));
    Numbers level = PICK(BELOW(lanes->tilt, SMALL_TILT), ALL(1) / root, ALL(-0.1) * root);
    for (int robot = 0; robot < ROBOTS; robot++) {
        earned[robot] = earned_by(lanes->height[robot], lanes->speed[robot], leveling + level);
        for (int behavior = 0; behavior <= BEHAVIORS; behavior++)
            lanes->credit[behavior] = ADDED(lanes->credit[behavior], controls(lanes, robot, behavior), earned[robot]);
    }
    lanes->total += earned[0] + earned[1] + earned[2];
}

static void set(Rows *rows, int lane, const double *height, const uint8_t *tables, const int64_t *structure) {
    for (int robot = 0; robot < ROBOTS; robot++) rows->height[robot][lane] = height[robot];
    for (int layer = 0; layer < BEHAVIORS; layer++) {
        int64_t behavior = structure[layer], word = 0;
        for (int cell = 0; cell < CELLS; cell++) word |= (int64_t)tables[behavior * CELLS + cell] << cell;
        rows->table[behavior][lane] = word;
        rows->priority[behavior][lane] = (layer + 1) * 8 + behavior + 1;
    }
}

static void load(Lanes *lanes, const Rows *rows) {
    *lanes = (Lanes){0};
    for (int robot = 0; robot < ROBOTS; robot++) lanes->height[robot] = LOAD(rows->height[robot]);
    for (int behavior = 0; behavior < BEHAVIORS; behavior++) {
        lanes->table[behavior] = LOAD_WORDS(rows->table[behavior]);
        lanes->priority[behavior] = LOAD_WORDS(rows->priority[behavior]);
    }
    lanes->slope = slope_of(lanes->height);
    sense(lanes);
}

static void store(const Lanes *lanes, Rows *rows) {
    STORE(rows->total, lanes->total);
    for (int behavior = 0; behavior <= BEHAVIORS; behavior++) STORE(rows->credit[behavior], lanes->credit[behavior]);
}

#define EACH(phase) for (int vector = 0; vector < VECTORS; vector++) phase

static void run(Rows *rows) {
    Lanes lanes[VECTORS];
    EACH(load(&lanes[vector], &rows[vector]));
    for (int step = 1; step <= STEPS; step++) {
        Numbers root = ALL(sqrt(step));
        EACH(decide(&lanes[vector]));
        EACH(act(&lanes[vector]));
        EACH(sense(&lanes[vector]));
        EACH(reward(&lanes[vector], root));
    }
    EACH(store(&lanes[vector], &rows[vector]));
}

void lift(int64_t agents, const double *heights, const uint8_t *tables, const int64_t *structures, double *returns,
          double *credit) {
    for (int64_t base = 0; base < agents; base += BATCH) {
        Rows rows[VECTORS] = {0};
        int64_t count = agents - base < BATCH ? agents - base : BATCH;
        for (int64_t lane = 0; lane < count; lane++)
            set(&rows[lane / WIDTH], (int)(lane % WIDTH), heights + (base + lane) * ROBOTS,
                tables + (base + lane) * BEHAVIORS * CELLS, structures + (base + lane) * BEHAVIORS);
        run(rows);
        for (int64_t lane = 0; lane < count; lane++) {
            const Rows *own = &rows[lane / WIDTH];
            returns[base + lane] = own->total[lane % WIDTH] / ROBOTS;
            for (int behavior = 0; behavior <= BEHAVIORS; behavior++)
                credit[(base + lane) * (BEHAVIORS + 1) + behavior] = own->credit[behavior][lane % WIDTH] / ROBOTS;
        }
    }
}
