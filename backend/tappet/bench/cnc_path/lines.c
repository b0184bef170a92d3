/* Words of G-code to lines in a ring, and velocities with look-ahead over the whole ring: what SMC_NCDecoder and
   SMC_CheckVelocities do with short lines in a plane, without their checks, states and other elements. */
#include <math.h>
#include <string.h>

enum { LINES = 10000, WORDS = 4 * LINES, ROOM = 100 };

struct word { unsigned char letter; double value; long integer; };
struct line {
    double from[12], to[12], velocity, end_velocity, acceleration, deceleration, length, tangent[3], cosine;
    int source, kind;
    double more[60]; /* as large as SMC_GEOINFO */
};

static struct word words[WORDS + 1];
static struct line ring[ROOM];
static int ready, first, count;
double result;

static struct line *at(int place) { return &ring[(first + place) % ROOM]; }

static void plan(void)
{
    double end = 0.0;
    for (int i = count - 1; i >= 0; i--) {
        struct line *l = at(i);
        double corner = i + 1 < count ? at(i + 1)->cosine : -1.0;
        double limit = corner > 0.98 ? fmin(l->velocity, at(i + 1)->velocity) : 0.0;
        double room = i + 1 < count ? 2.0 * at(i + 1)->deceleration * at(i + 1)->length : 0.0;
        l->end_velocity = fmin(limit, sqrt(end * end + room));
        end = l->end_velocity;
    }
}

void cycle(void)
{
    if (!ready) {
        double angle = 0.0, x = 0.0, y = 0.0;
        ready = 1;
        for (int i = 0; i < LINES; i++) {
            angle += 0.01;
            x += 0.1 * cos(angle);
            y += 0.1 * sin(angle);
            words[4 * i] = (struct word){'G', 1.0, 1};
            words[4 * i + 1] = (struct word){'X', x, 0};
            words[4 * i + 2] = (struct word){'Y', y, 0};
            words[4 * i + 3] = (struct word){0, 0.0, i + 1};
        }
    }
    struct line l;
    double position[12] = {0.0}, target[12] = {0.0}, tangent[3] = {1.0, 0.0, 0.0};
    int motion = 0;
    first = count = 0;
    result = 0.0;
    for (int i = 0; i < WORDS; i++) {
        switch (words[i].letter) {
        case 'G': motion = words[i].integer; break;
        case 'X': target[0] = words[i].value; break;
        case 'Y': target[1] = words[i].value; break;
        case 'Z': target[2] = words[i].value; break;
        case 0:
            memset(&l, 0, sizeof l);
            memcpy(l.from, position, sizeof position);
            memcpy(l.to, target, sizeof target);
            l.kind = motion;
            l.source = words[i].integer;
            l.velocity = 50.0;
            l.acceleration = l.deceleration = 100.0;
            for (int k = 0; k < 3; k++)
                l.length += (target[k] - position[k]) * (target[k] - position[k]);
            l.length = sqrt(l.length);
            for (int k = 0; k < 3; k++) {
                l.tangent[k] = (target[k] - position[k]) / l.length;
                l.cosine += l.tangent[k] * tangent[k];
                tangent[k] = l.tangent[k];
            }
            memcpy(position, target, sizeof position);
            if (count == ROOM) {
                plan();
                while (count > 0) {
                    result += at(0)->end_velocity;
                    first = (first + 1) % ROOM;
                    count--;
                }
            }
            *at(count++) = l;
            break;
        }
    }
    plan();
}
