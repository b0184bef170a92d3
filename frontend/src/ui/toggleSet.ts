import { useState } from 'react';

/** A copy of a set with `value` put in, or taken out where it was in. */
export function toggledIn<Value>(values: ReadonlySet<Value>, value: Value): ReadonlySet<Value> {
  const next = new Set(values);
  if (!next.delete(value)) next.add(value);
  return next;
}

/** Values that a click puts in or takes out: rows that are closed, kinds that are hidden. */
export function useToggleSet<Value>(initial?: Iterable<Value>): [ReadonlySet<Value>, (value: Value) => void] {
  const [values, setValues] = useState<ReadonlySet<Value>>(() => new Set(initial));
  return [values, (value) => setValues((before) => toggledIn(before, value))];
}
