/** Which lines of an edited text are still the ones that run. Pure. */

/** For each line of `now` whether it stands unchanged in `running`, in order (longest common subsequence). */
export function unchangedLines(running: string, now: string): readonly boolean[] {
  const a = running.split('\n').map((line) => line.trim());
  const b = now.split('\n').map((line) => line.trim());
  let head = 0;
  while (head < a.length && head < b.length && a[head] === b[head]) head += 1;
  let tail = 0;
  while (tail < a.length - head && tail < b.length - head && a[a.length - 1 - tail] === b[b.length - 1 - tail])
    tail += 1;
  const result = b.map((_, line) => line < head || line >= b.length - tail);
  const left = a.slice(head, a.length - tail);
  const right = b.slice(head, b.length - tail);
  // Long rewritten regions are taken as changed rather than compared line by line.
  if (left.length * right.length > 250_000) return result;
  const lengths = lcsLengths(left, right);
  for (let i = 0, j = 0; i < left.length && j < right.length;) {
    if (left[i] === right[j]) {
      result[head + j] = true;
      i += 1;
      j += 1;
    } else if (at(lengths, i + 1, j) >= at(lengths, i, j + 1)) i += 1;
    else j += 1;
  }
  return result;
}

function at(lengths: readonly Uint32Array[], i: number, j: number): number {
  return lengths[i]?.[j] ?? 0;
}

function lcsLengths(left: readonly string[], right: readonly string[]): Uint32Array[] {
  const lengths = Array.from({ length: left.length + 1 }, () => new Uint32Array(right.length + 1));
  for (let i = left.length - 1; i >= 0; i -= 1) {
    for (let j = right.length - 1; j >= 0; j -= 1) {
      const row = lengths[i] as Uint32Array;
      row[j] =
        left[i] === right[j] ? at(lengths, i + 1, j + 1) + 1 : Math.max(at(lengths, i + 1, j), at(lengths, i, j + 1));
    }
  }
  return lengths;
}
