/** The sources of the front end, for tests that look at what is written in them. */
import { readdirSync } from 'node:fs';
import { join } from 'node:path';

export const SRC = join(import.meta.dirname, '../src');

/** Files of TypeScript below a folder, without tests and generated ones; `left` are folders that are left out. */
export function sources(folder: string, left: readonly string[] = []): string[] {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return left.includes(path) ? [] : sources(path, left);
    return /\.tsx?$/.test(path) && !/\.test\.tsx?$|(schema|grammar)\.ts$/.test(path) ? [path] : [];
  });
}
