import type { t as text } from '@/i18n';
import { millisecondText } from '../clock';
import type { PastMoment } from '../onlineSession';

/** `cycle 1234, 12:03:11.120, 2.3 s before the fault` */
export function pastText(past: PastMoment, t: typeof text): string {
  const values = { cycle: past.cycle, time: momentText(past.at), before: spanText(past.before) };
  if (past.before === 0) return t(past.fault ? 'past.atFault' : 'past.atEnd', values);
  return t(past.fault ? 'past.beforeFault' : 'past.beforeEnd', values);
}

/** `12:03:11.120` */
export function momentText(at: number): string {
  return millisecondText(new Date(at).toISOString()).slice(11);
}

/** A span in ms as people read it: `80 ms`, `2.31 s`. */
export function spanText(ms: number): string {
  if (ms < 1000) return `${String(Number(ms.toPrecision(3)))} ms`;
  return `${(ms / 1000).toFixed(2)} s`;
}
