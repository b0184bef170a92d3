/* 1,000 axes that follow trajectories planned before: a cubic segment each, looked up and evaluated once a cycle. */
enum { AXES = 1000, SEGMENTS = 7 };

struct segment { double start, position, velocity, acceleration, jerk; };
struct axis {
    struct segment segments[SEGMENTS];
    int active;
    double time, position, velocity, acceleration;
};

static struct axis axes[AXES];
static int ready;
double result;

void cycle(void)
{
    if (!ready) {
        ready = 1;
        for (int i = 0; i < AXES; i++)
            for (int s = 0; s < SEGMENTS; s++)
                axes[i].segments[s] = (struct segment){1e6 * s, 10.0 * s, 1.0 + i, 2.0, 1e-3};
    }
    for (int i = 0; i < AXES; i++) {
        struct axis *a = &axes[i];
        a->time += 0.001;
        while (a->active < SEGMENTS - 1 && a->time >= a->segments[a->active + 1].start)
            a->active++;
        const struct segment *s = &a->segments[a->active];
        double t = a->time - s->start;
        a->acceleration = s->acceleration + t * s->jerk;
        a->velocity = s->velocity + t * (s->acceleration + t * 0.5 * s->jerk);
        a->position = s->position + t * (s->velocity + t * (0.5 * s->acceleration + t * s->jerk / 6.0));
    }
    result = axes[AXES - 1].position;
}
