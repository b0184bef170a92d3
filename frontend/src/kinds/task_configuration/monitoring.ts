/** What the charts of the task monitoring show. Pure functions. */
import type { LoadOfTasks, TaskTimes } from '@/api/types';

export interface LoadSeries {
  name: string;
  /** A task, or a processor of the host. */
  of: 'task' | 'processor';
  /** Percent of one processor. */
  values: readonly number[];
}

/** Seconds before the newest sample, and the percentages of each task and each processor. */
export function loadSeries(
  load: LoadOfTasks,
  seconds: number,
  processor: (number: number) => string,
): { ago: number[]; series: LoadSeries[] } {
  const newest = Date.parse(load.samples.at(-1)?.at ?? '');
  const shown = load.samples.filter((sample) => newest - Date.parse(sample.at) <= seconds * 1000);
  const tasks = load.tasks.map((name, at): LoadSeries => ({
    name,
    of: 'task',
    values: shown.map((sample) => sample.tasks[at] ?? 0),
  }));
  const processors = load.processors.map((number, at): LoadSeries => ({
    name: processor(number),
    of: 'processor',
    values: shown.map((sample) => sample.processors[at] ?? 0),
  }));
  return {
    ago: shown.map((sample) => (Date.parse(sample.at) - newest) / 1000),
    series: [...tasks, ...processors],
  };
}

/** The samples known so far and those that came later; another application begins anew. */
export function joinedLoad(known: LoadOfTasks | undefined, fresh: LoadOfTasks, most: number): LoadOfTasks {
  const same =
    known !== undefined &&
    known.tasks.join('\n') === fresh.tasks.join('\n') &&
    known.processors.join() === fresh.processors.join();
  return same ? { ...fresh, samples: [...known.samples, ...fresh.samples].slice(-most) } : fresh;
}

export interface Bar {
  fromUs: number;
  toUs: number;
  count: number;
  /** Of all cycles, 0 to 1. */
  share: number;
  /** Cycles up to and with this class, 0 to 1. */
  reached: number;
}

const FEWEST_BARS = 12;

/** The classes between the first and the last that hold anything, with some around them where they are few. */
export function bars(times: TaskTimes, what: 'cycles' | 'starts'): Bar[] {
  const counts = times.classes.map((one) => one[what]);
  const all = counts.reduce((sum, count) => sum + count, 0);
  if (all === 0) return [];
  let first = counts.findIndex((count) => count > 0);
  let last = counts.findLastIndex((count) => count > 0);
  while (last - first + 1 < FEWEST_BARS && (first > 0 || last < counts.length - 1)) {
    if (last < counts.length - 1) last += 1;
    if (last - first + 1 < FEWEST_BARS && first > 0) first -= 1;
  }
  let sum = counts.slice(0, first).reduce((before, count) => before + count, 0);
  return times.classes.slice(first, last + 1).map((one, at) => {
    sum += one[what];
    return {
      fromUs: one.from_us,
      toUs: times.classes[first + at + 1]?.from_us ?? Infinity,
      count: one[what],
      share: one[what] / all,
      reached: sum / all,
    };
  });
}

/** Each second octave in a row of bars, for the axis: number of the bar and its lower edge. */
export function edges(shown: readonly Bar[], every: number): { at: number; us: number }[] {
  return shown.flatMap((bar, at) => (at % every === 0 ? [{ at, us: bar.fromUs }] : []));
}
