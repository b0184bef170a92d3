/** Library contents as a tree of folders by kind, and the pins of a block as it is drawn. Pure functions. */
import type { Library, LibraryItem, Pin } from '@/api/types';
import type { TextKey } from '@/i18n';

/** What identifies an installed library. */
export interface LibraryId {
  name: string;
  version: string;
}

export function idOf({ name, version }: LibraryId): string {
  return `${name} ${version}`;
}

/** Versions compare number by number. */
export function compareVersions(a: string, b: string): number {
  const left = a.split('.').map(Number);
  const right = b.split('.').map(Number);
  for (let at = 0; at < Math.max(left.length, right.length); at++) {
    const difference = (left[at] ?? 0) - (right[at] ?? 0);
    if (difference) return difference;
  }
  return 0;
}

/** Version to save a library in: the newest one of its name with the last number raised, else 1.0.0.0. */
export function nextVersion(name: string, installed: readonly LibraryId[]): string {
  const versions = installed.filter((library) => library.name === name).map((library) => library.version);
  const newest = versions.sort(compareVersions).at(-1);
  if (newest === undefined) return '1.0.0.0';
  const numbers = newest.split('.').map(Number);
  return [...numbers.slice(0, -1), numbers.at(-1)! + 1].join('.');
}

export interface LibraryFaults {
  name: TextKey | null;
  version: TextKey | null;
  namespace: TextKey | null;
}

/** What is wrong with the name, version and namespace of a library to be saved. */
export function libraryFaults(
  facts: { name: string; version: string; namespace: string },
  installed: readonly (LibraryId & { removable: boolean })[],
): LibraryFaults {
  const fixed = installed.some(
    (library) =>
      !library.removable &&
      library.name.toUpperCase() === facts.name.toUpperCase() &&
      library.version === facts.version,
  );
  return {
    name: /^[A-Za-z_][A-Za-z0-9_. -]{0,79}$/.test(facts.name) ? null : 'libraries.nameFault',
    version: !/^\d+(\.\d+){0,3}$/.test(facts.version) ? 'libraries.versionFault' : fixed ? 'libraries.stays' : null,
    namespace: /^([A-Za-z_]\w*)?$/.test(facts.namespace) ? null : 'library.namespaceFault',
  };
}

const GROUPS = ['function_block', 'function', 'interface', 'data', 'global'] as const;
export type Group = (typeof GROUPS)[number];

/** Which folder an item stands in. */
export function groupOf(kind: string): Group {
  if (kind === 'parameter_list') return 'global';
  if (kind === 'function_block' || kind === 'function' || kind === 'interface' || kind === 'global') return kind;
  return kind === 'program' ? 'function_block' : 'data';
}

export interface ItemGroup {
  group: Group;
  items: LibraryItem[];
}

/** Items by kind, each folder in the order of names; with a search only what matches by name or comment. */
export function groupsOf(library: Library, search = ''): ItemGroup[] {
  const wanted = search.trim().toLowerCase();
  const items = library.items.filter(
    (item) => !wanted || `${item.name} ${item.summary}`.toLowerCase().includes(wanted),
  );
  return GROUPS.map((group) => ({
    group,
    items: items.filter((item) => groupOf(item.kind) === group).sort((a, b) => a.name.localeCompare(b.name)),
  })).filter((entry) => entry.items.length > 0);
}

export interface BlockPin {
  name: string;
  type: string;
  /** In/out pins are drawn at both sides. */
  inOut?: boolean;
}

/** The pins as FBD draws them: inputs and in/outs at the left, outputs and in/outs at the right. */
export function blockPins(item: LibraryItem): { left: BlockPin[]; right: BlockPin[] } {
  const plain = (pins: readonly Pin[]) => pins.map(({ name, type }) => ({ name, type }));
  const both = item.in_out.map(({ name, type }) => ({ name, type, inOut: true }));
  const result = item.returns ? [{ name: item.name, type: item.returns }] : [];
  return { left: [...both, ...plain(item.inputs)], right: [...both, ...result, ...plain(item.outputs)] };
}
