/* A position on a chain of lines in each cycle: a trapezoid of velocity along each, and the point of three axes. */
enum { LINES = 1000, CYCLES = 1000 };

struct line { double from[3], way[3], length, speed; };

static struct line lines[LINES];
static int ready, active;
static double along, position[3];
double result;

void cycle(void)
{
    if (!ready) {
        ready = 1;
        for (int i = 0; i < LINES; i++)
            lines[i] = (struct line){{i, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.0, 50.0};
    }
    for (int n = 0; n < CYCLES; n++) {
        along += lines[active].speed * 0.001;
        while (along >= lines[active].length) {
            along -= lines[active].length;
            active = (active + 1) % LINES;
        }
        for (int k = 0; k < 3; k++)
            position[k] = lines[active].from[k] + lines[active].way[k] * (along / lines[active].length);
        result = position[0] + position[1] + position[2];
    }
}
