/* The lifting task as one would port it to C: one episode at a time, branches, the C library's functions.
   TUNED: by hand faster, with a plain square root for hypot and a table of the steps' roots. */
#include <math.h>
#include <stdint.h>
#include <string.h>

enum { STEPS = 300, ROBOTS = 3, BEHAVIORS = 5, CELLS = 6 };
enum { PUSH_MORE, DO_NOT_GO_FAST, STOP_AT_GOAL, HURRY_UP, SLOW_DOWN, NOBODY };

static const double SPEED_STEP = 1, TOP_SPEED = 5, GOAL = 3, SMALL_TILT = 5, DT = 0.005, RADIUS = 1;

#ifdef TUNED
static double root_of[STEPS + 1];
#define HYPOT(x, y) sqrt((x) * (x) + (y) * (y))
#define ROOT(step) root_of[step]
#else
#define HYPOT(x, y) hypot(x, y)
#define ROOT(step) sqrt(step)
#endif

static double tilt_of(const double *height) {
    double sideways = (height[2] - height[1]) / (sqrt(3) * RADIUS);
    double forward = (height[0] - (height[1] + height[2]) / 2) / (1.5 * RADIUS);
    return atan(HYPOT(sideways, forward)) * 57.29577951308232;
}

static int place_of(const double *height, int robot) {
    double lowest = fmin(fmin(height[0], height[1]), height[2]);
    double highest = fmax(fmax(height[0], height[1]), height[2]);
    return height[robot] == lowest ? 0 : height[robot] == highest ? 1 : 2;
}

static int cell_of(int behavior, double speed, int reached, int place_and_tilted) {
    switch (behavior) {
    case PUSH_MORE: return 0;
    case DO_NOT_GO_FAST: return speed > 0 ? speed < 5 ? (int)speed : 5 : 0;
    case STOP_AT_GOAL: return reached;
    default: return place_and_tilted;
    }
}

static double speed_after(int behavior, double speed) {
    switch (behavior) {
    case PUSH_MORE: return speed + SPEED_STEP;
    case DO_NOT_GO_FAST: return speed < TOP_SPEED ? speed : TOP_SPEED;
    case STOP_AT_GOAL: return 0;
    case HURRY_UP: return speed + SPEED_STEP < TOP_SPEED ? speed + SPEED_STEP : TOP_SPEED;
    case SLOW_DOWN: return speed - SPEED_STEP > 0 ? speed - SPEED_STEP : 0;
    default: return speed;
    }
}

static double episode(const double *start, const uint8_t *tables, const int64_t *structure, double *credit) {
    double height[ROBOTS], speed[ROBOTS] = {0}, total = 0;
    memcpy(height, start, sizeof height);
    double tilt = tilt_of(height);
    for (int step = 1; step <= STEPS; step++) {
        int controlling[ROBOTS], tilted = tilt > SMALL_TILT;
        for (int robot = 0; robot < ROBOTS; robot++) {
            int place = place_of(height, robot), reached = height[robot] >= GOAL;
            controlling[robot] = NOBODY;
            for (int layer = BEHAVIORS - 1; layer >= 0; layer--) {
                int behavior = (int)structure[layer];
                if (tables[behavior * CELLS + cell_of(behavior, speed[robot], reached, place * 2 + tilted)]) {
                    controlling[robot] = behavior;
                    break;
                }
            }
        }
        for (int robot = 0; robot < ROBOTS; robot++) {
            speed[robot] = speed_after(controlling[robot], speed[robot]);
            height[robot] += speed[robot] * DT;
        }
        double before = tilt, together = 0;
        tilt = tilt_of(height);
        double leveling = tilt - before < -0.5 ? 1 : -0.1;
        double level = tilt < SMALL_TILT ? 1 / ROOT(step) : -0.1 * ROOT(step);
        for (int robot = 0; robot < ROBOTS; robot++) {
            double earned = leveling + level;
            earned += fabs(height[robot] - GOAL) < 0.5 ? 1 : -0.1;
            earned += height[robot] > GOAL + 0.2 ? -1 : 0;
            earned += fabs(speed[robot]) > TOP_SPEED ? -0.1 : 0;
            credit[controlling[robot]] += earned;
            together = robot ? together + earned : earned;
        }
        total += together;
    }
    return total / ROBOTS;
}

void lift(int64_t agents, const double *heights, const uint8_t *tables, const int64_t *structures, double *returns,
          double *credit) {
#ifdef TUNED
    for (int step = 0; step <= STEPS; step++) root_of[step] = sqrt(step);
#endif
    for (int64_t agent = 0; agent < agents; agent++) {
        double earned[BEHAVIORS + 1] = {0};
        returns[agent] = episode(heights + agent * ROBOTS, tables + agent * BEHAVIORS * CELLS,
                                 structures + agent * BEHAVIORS, earned);
        for (int behavior = 0; behavior <= BEHAVIORS; behavior++)
            credit[agent * (BEHAVIORS + 1) + behavior] = earned[behavior] / ROBOTS;
    }
}
