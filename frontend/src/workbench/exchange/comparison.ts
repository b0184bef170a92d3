/** Where the import gets the comparison of an object with that of the project from: the text editors register it. */
import type { Schemas } from '@/api/types';

export interface ComparedObject {
  name: string;
  comparison: Schemas['Comparison'];
  /** What the user has made of the texts before. */
  texts: Record<string, string> | undefined;
}

/** Shows both and lets the user join them; undefined when nothing was decided. */
type Comparing = (compared: ComparedObject) => Promise<Record<string, string> | undefined>;

let comparing: Comparing | null = null;

export function setImportComparison(show: Comparing): void {
  comparing = show;
}

export async function compareImport(compared: ComparedObject): Promise<Record<string, string> | undefined> {
  return comparing?.(compared);
}
