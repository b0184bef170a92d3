#include <stdint.h>
double result;
static uint32_t table[256], crc, n;
static uint8_t data[512], ready;
static int32_t i, k;
void cycle(void) {
    if (!ready) {
        for (i = 0; i <= 255; i++) {
            uint32_t e = (uint32_t)i;
            for (k = 1; k <= 8; k++) e = (e & 1) ? (e >> 1) ^ 0xEDB88320u : e >> 1;
            table[i] = e;
        }
        for (i = 0; i <= 511; i++) data[i] = (uint8_t)((i * 37) % 256);
        ready = 1;
    }
    n++;
    data[0] = (uint8_t)n;
    crc = 0xFFFFFFFFu;
    for (i = 0; i <= 511; i++) crc = (crc >> 8) ^ table[(crc ^ data[i]) & 0xFF];
    result = (double)(uint32_t)~crc;
}
