/* specs/mobile_robot.yaml as one would port it to C: one episode at a time, branches, the C library's functions.
   Draws are those of bbsd/kernel/streams.py, so that the episodes are the same.
   BBSD_FUNCTIONS: with bbsd's functions instead of the C library's. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef BBSD_FUNCTIONS
#include "bbsd_functions.h"
#define SIN bbsd_sin
#define COS bbsd_cos
#define ATAN2 bbsd_atan2
#define LOG bbsd_log
#define HYPOT(x, y) sqrt((x) * (x) + (y) * (y))
#else
#define SIN sin
#define COS cos
#define ATAN2 atan2
#define LOG log
#define HYPOT hypot
#endif

enum { STEPS = 600, BEHAVIORS = 3, CELLS = 8, SONARS = 8, EYES = 4, OBSTACLES = 3 };
enum { WANDER, SEEK_LIGHT, AVOID_OBSTACLES, NOBODY };

static const double WIDTH = 10, DEPTH = 8, LAMP_X = 9, LAMP_Y = 7, BODY = 0.2, REACH = 5, NOISE = 0.05, DT = 0.1;
static const double OBSTACLE[OBSTACLES][3] = {{3, 2, 0.5}, {5, 5.5, 0.7}, {7.5, 3, 0.6}};
static const double SONAR[SONARS] = {90, 50, 30, 10, -10, -30, -50, -90}, EYE[EYES] = {135, 45, -45, -135};
static const double PI = 3.141592653589793, RADIAN = 0.017453292519943295;

/* The names of the draws, as bbsd derives them from their places in the spec. */
typedef struct {
    uint64_t x, y, heading, first_whim, whim, sonar[SONARS], light[EYES];
} Words;

typedef struct {
    double x, y, heading, forward, turn, whim, sonar[SONARS], light[EYES];
    int bumped;
} Robot;

static inline uint64_t mixed(uint64_t word) {
    word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9;
    word = (word ^ (word >> 27)) * 0x94D049BB133111EB;
    return word ^ (word >> 31);
}

static inline uint64_t fold(uint64_t key, uint64_t word) { return mixed(key ^ mixed(word + 0x9E3779B97F4A7C15)); }

static inline double unit(uint64_t bits) { return (double)(int64_t)(bits >> 11) * 0x1p-53; }

static inline double uniform(uint64_t key, uint64_t word, double low, double high) {
    return low + (high - low) * unit(fold(key, word));
}

static inline double normal(uint64_t key, uint64_t word, double mean, double sd) {
    uint64_t bits = fold(key, word);
    double radius = sqrt(-2.0 * LOG(1.0 - unit(bits)));
    return mean + sd * (radius * COS(2.0 * PI * unit(mixed(bits ^ 0x9E3779B97F4A7C15))));
}

static inline double smaller(double a, double b) { return b < a ? b : a; }
static inline double greater(double a, double b) { return b > a ? b : a; }

static double clearance(double x, double y) {
    double least = smaller(smaller(x, WIDTH - x), smaller(y, DEPTH - y));
    for (int i = 0; i < OBSTACLES; i++)
        least = smaller(least, HYPOT(OBSTACLE[i][0] - x, OBSTACLE[i][1] - y) - OBSTACLE[i][2]);
    return least - BODY;
}

/* The distance to the first obstacle that a ray from the robot meets; `cosine` and `sine` give its direction. */
static double to_obstacle(const Robot *robot, double cosine, double sine) {
    double least = WIDTH + DEPTH;
    for (int i = 0; i < OBSTACLES; i++) {
        double dx = OBSTACLE[i][0] - robot->x, dy = OBSTACLE[i][1] - robot->y, r = OBSTACLE[i][2];
        double along = dx * cosine + dy * sine, aside = fabs(dy * cosine - dx * sine);
        if (along > 0 && aside < r) least = smaller(least, along - sqrt(greater(r * r - aside * aside, 0)));
    }
    return least;
}

static double echo(const Robot *robot, double angle) {
    double cosine = COS(angle), sine = SIN(angle);
    double wall = smaller(((cosine > 0 ? WIDTH : 0) - robot->x) / cosine, ((sine > 0 ? DEPTH : 0) - robot->y) / sine);
    return smaller(smaller(REACH, wall), to_obstacle(robot, cosine, sine));
}

static double distance_to_lamp(const Robot *robot) { return HYPOT(LAMP_X - robot->x, LAMP_Y - robot->y); }

static void sense(Robot *robot, uint64_t key, const Words *words, uint64_t step) {
    for (int i = 0; i < SONARS; i++)
        robot->sonar[i] = echo(robot, robot->heading + SONAR[i] * RADIAN) +
                          normal(key, fold(words->sonar[i], step), 0.0, NOISE);
    double bearing = ATAN2(LAMP_Y - robot->y, LAMP_X - robot->x), far = distance_to_lamp(robot);
    int lit = to_obstacle(robot, COS(bearing), SIN(bearing)) > far;
    for (int i = 0; i < EYES; i++) {
        double seen = lit ? greater(COS(bearing - (robot->heading + EYE[i] * RADIAN)), 0) / (far * far) : 0;
        robot->light[i] = seen * normal(key, fold(words->light[i], step), 1.0, NOISE);
    }
}

static double least_of(const double *values, int count) {
    double least = values[0];
    for (int i = 1; i < count; i++) least = smaller(least, values[i]);
    return least;
}

static double most_of(const double *values, int count) {
    double most = values[0];
    for (int i = 1; i < count; i++) most = greater(most, values[i]);
    return most;
}

static int brightest(const double *light) {
    double most = most_of(light, EYES);
    if (smaller(light[1], light[2]) > 0.7 * most) return 0;
    for (int i = 0; i < 3; i++)
        if (light[i] == most) return i + 1;
    return 4;
}

/* Returns the controlling behavior and stores its action, counted from 1, in `action`. */
static int controlling(const Robot *robot, const uint8_t *tables, const int64_t *structure, int *action) {
    int left = least_of(robot->sonar, 2) < 0.6, front = least_of(robot->sonar + 2, 4) < 0.8;
    int right = least_of(robot->sonar + 6, 2) < 0.6;
    int cells[BEHAVIORS] = {0, brightest(robot->light), (left * 2 + front) * 2 + right};
    int excited[BEHAVIORS] = {1, most_of(robot->light, EYES) > 0, least_of(robot->sonar, SONARS) < 1};
    for (int layer = BEHAVIORS - 1; layer >= 0; layer--) {
        int behavior = (int)structure[layer];
        *action = tables[behavior * CELLS + cells[behavior]];
        if (excited[behavior] && *action) return behavior;
    }
    return NOBODY;
}

static void act(Robot *robot, int behavior, int action) {
    static const double SEEK[][2] = {{0.3, 1}, {0.6, 0}, {0.3, -1}}, AVOID[][2] = {{0.1, 1.5}, {0.1, -1.5}, {-0.3, 0.5}};
    if (behavior == WANDER) robot->forward = 0.5, robot->turn = robot->whim;
    if (behavior == SEEK_LIGHT) robot->forward = SEEK[action - 1][0], robot->turn = SEEK[action - 1][1];
    if (behavior == AVOID_OBSTACLES) robot->forward = AVOID[action - 1][0], robot->turn = AVOID[action - 1][1];
}

static void move(Robot *robot, uint64_t key, const Words *words, int step) {
    double x = robot->x + robot->forward * COS(robot->heading) * DT;
    double y = robot->y + robot->forward * SIN(robot->heading) * DT;
    int free = clearance(x, y) > 0;
    if (free) robot->x = x, robot->y = y;
    robot->bumped = !free;
    robot->heading += robot->turn * DT;
    if (step % 20 == 0) robot->whim = uniform(key, fold(words->whim, (uint64_t)step), -0.5, 0.5);
}

static double episode(uint64_t key, const Words *words, const uint8_t *tables, const int64_t *structure, double *credit) {
    Robot robot = {.x = uniform(key, fold(words->x, 0), 1, 2), .y = uniform(key, fold(words->y, 0), 1, 7),
                   .heading = uniform(key, fold(words->heading, 0), -PI, PI),
                   .whim = uniform(key, fold(words->first_whim, 0), -0.5, 0.5)};
    sense(&robot, key, words, 0);
    double total = 0, far = distance_to_lamp(&robot);
    for (int step = 1; step <= STEPS && far >= 0.5; step++) {
        int action, behavior = controlling(&robot, tables, structure, &action), bumped = robot.bumped;
        act(&robot, behavior, action);
        move(&robot, key, words, step);
        sense(&robot, key, words, (uint64_t)step);
        double before = far;
        far = distance_to_lamp(&robot);
        double earned = before - far + (far < 0.5 ? 10 : 0) + (robot.bumped && !bumped ? -5 : 0);
        credit[behavior] += earned;
        total += earned;
    }
    return total;
}

void wander(int64_t agents, const uint64_t *keys, const Words *words, const uint8_t *tables, const int64_t *structures,
            double *returns, double *credit) {
    for (int64_t agent = 0; agent < agents; agent++) {
        double *earned = credit + agent * (BEHAVIORS + 1);
        memset(earned, 0, (BEHAVIORS + 1) * sizeof *earned);
        returns[agent] = episode(keys[agent], words, tables + agent * BEHAVIORS * CELLS,
                                 structures + agent * BEHAVIORS, earned);
    }
}
