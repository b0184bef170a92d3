/** Points in time in local time and in an order that sorts, the same in every language. Pure functions. */

const two = (number: number) => String(number).padStart(2, '0');

/** `2026-03-10 08:15:02` */
export function secondText(at: string): string {
  const date = new Date(at);
  const day = `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())}`;
  return `${day} ${two(date.getHours())}:${two(date.getMinutes())}:${two(date.getSeconds())}`;
}

/** `2026-03-10 08:15:02.045` */
export function millisecondText(at: string): string {
  return `${secondText(at)}.${String(new Date(at).getMilliseconds()).padStart(3, '0')}`;
}

/** `08:15:02`, of milliseconds since 1970: for moments of today. */
export function timeText(at: number): string {
  return secondText(new Date(at).toISOString()).slice(11);
}
