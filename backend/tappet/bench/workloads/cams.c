#include <stdint.h>
double result;
typedef struct { double x0, x1, c[6]; } Segment;
typedef struct { double master, position, velocity, acceleration; int16_t segment; double u, width; } Slave;
static Slave slaves[64];
static Segment table[16];
static double master;
static uint8_t ready;
static void slave(Slave *s, Segment *t) {
    while (s->master >= t[s->segment].x1 && s->segment < 15) s->segment++;
    while (s->master < t[s->segment].x0 && s->segment > 0) s->segment--;
    Segment *g = &t[s->segment];
    s->width = g->x1 - g->x0;
    double u = s->u = (s->master - g->x0) / s->width;
    s->position = g->c[0] + u * (g->c[1] + u * (g->c[2] + u * (g->c[3] + u * (g->c[4] + u * g->c[5]))));
    s->velocity = (g->c[1] + u * (2.0 * g->c[2] + u * (3.0 * g->c[3] + u * (4.0 * g->c[4] + u * 5.0 * g->c[5])))) / s->width;
    s->acceleration = (2.0 * g->c[2] + u * (6.0 * g->c[3] + u * (12.0 * g->c[4] + u * 20.0 * g->c[5]))) / (s->width * s->width);
}
void cycle(void) {
    if (!ready) {
        for (int i = 0; i < 16; i++) {
            double from = i * 0.5 - (i % 3), to = (i + 1) * 0.5 - ((i + 1) % 3);
            table[i].x0 = i * 22.5;
            table[i].x1 = (i + 1) * 22.5;
            table[i].c[0] = from;
            table[i].c[3] = 10.0 * (to - from);
            table[i].c[4] = -15.0 * (to - from);
            table[i].c[5] = 6.0 * (to - from);
        }
        ready = 1;
    }
    master += 0.37;
    if (master >= 360.0) master -= 360.0;
    for (int j = 0; j < 64; j++) {
        double at = master + j * 5.0;
        if (at >= 360.0) at -= 360.0;
        slaves[j].master = at;
        slave(&slaves[j], table);
        result = result + slaves[j].position + slaves[j].velocity * 0.01 + slaves[j].acceleration * 0.001;
    }
}
