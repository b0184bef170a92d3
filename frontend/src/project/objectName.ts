import type { ObjectSummary } from '@/api/types';
import { allKinds, kindOf, kindTitle } from './kinds';

/** Objects whose name is fixed are called in the user's language: the project says `Library Manager` in any. */
export function displayName(object: Pick<ObjectSummary, 'kind' | 'name'>): string {
  return kindOf(object.kind)?.tree?.fixedName ? kindTitle(object.kind) : object.name;
}

/** A path of the server, `Device/PLC Logic/App`, with fixed names in the user's language. */
export function displayPath(path: string, separator = ' / '): string {
  return path.split('/').map(displayPart).join(separator);
}

function displayPart(name: string): string {
  const fixed = allKinds().find(({ tree }) => tree?.fixedName === name);
  return fixed ? kindTitle(fixed.kind) : name;
}

/** The path of what the object is below; empty at the top. */
export function displayPlace(path: string, separator?: string): string {
  const end = path.lastIndexOf('/');
  return end < 0 ? '' : displayPath(path.slice(0, end), separator);
}
