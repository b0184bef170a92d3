/* 1,000 slaves by one cam: the polynomial of fifth degree between two of its points, looked up and evaluated once a cycle. */
enum { SLAVES = 1000, POINTS = 4 };

struct point { double x, y, v, a; };
struct slave { int at; double position, velocity, acceleration; };

static const struct point points[POINTS] = {{0, 0, 0, 0}, {120, 120, 1, 0}, {240, 240, 1, 0}, {360, 360, 0, 0}};
static struct slave slaves[SLAVES];
static double master;
double result;

void cycle(void)
{
    const double speed = 100.0;
    master += 0.001 * speed;
    if (master >= 360.0)
        master -= 360.0;
    for (int i = 0; i < SLAVES; i++) {
        struct slave *s = &slaves[i];
        while (s->at > 0 && master < points[s->at].x)
            s->at--;
        while (s->at < POINTS - 2 && master >= points[s->at + 1].x)
            s->at++;
        const struct point *p = &points[s->at], *q = p + 1;
        double h = q->x - p->x, t = (master - p->x) / h;
        double d = q->y - p->y, v0 = p->v * h, v1 = q->v * h, a0 = p->a * h * h, a1 = q->a * h * h;
        double c3 = 10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1;
        double c4 = -15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1;
        double c5 = 6 * d - 3 * v0 - 3 * v1 - 0.5 * a0 + 0.5 * a1;
        s->position = p->y + t * (v0 + t * (0.5 * a0 + t * (c3 + t * (c4 + t * c5))));
        s->velocity = (v0 + t * (a0 + t * (3 * c3 + t * (4 * c4 + t * 5 * c5)))) / h * speed;
        s->acceleration = (a0 + t * (6 * c3 + t * (12 * c4 + t * 20 * c5))) / (h * h) * speed * speed;
    }
    result = slaves[SLAVES - 1].position;
}
