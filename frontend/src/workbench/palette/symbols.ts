/** Members of objects for quick open: variables, labels, methods and types of the project, or of the active object. */
import { Braces, CircleDot, ListTree, Tag, Variable } from 'lucide-react';
import { useEffect, useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { commandContext } from '../context';
import { openObject } from '../docking/dock';
import { parsePartUri, type Part } from '@/project/partUri';
import { holdsValues } from '@/project/kinds';
import { objectPath } from '@/project/tree';
import type { IconComponent } from '@/icons/IconComponent';
import type { PaletteItem } from './items';
import { symbolSource, type MemberSymbol, type ProjectSymbol } from './symbolSource';

const SHORTEST = 2;
const PAUSE_MS = 120;
/** Kinds of the protocol: enum 10, key (a jump label) 20, enum member 22, struct 23. */
const ICONS: Readonly<Record<number, IconComponent>> = { 10: ListTree, 20: Tag, 22: CircleDot, 23: Braces };
/** Sections of a declaration (VAR_INPUT ...) are namespaces; fields, variables and constants have a value. */
const SECTION = 3;
const VARIABLE_KINDS = new Set([8, 13, 14]);

interface Target {
  objectId: string;
  part: Part;
  line: number;
  column: number;
}

function item(
  name: string,
  kind: number,
  detail: string,
  target: Target,
  objects: readonly ObjectSummary[],
): PaletteItem {
  const { objectId, ...place } = target;
  const owner = objects.find((object) => object.id === objectId);
  const watchable = owner !== undefined && holdsValues(owner) && VARIABLE_KINDS.has(kind);
  return {
    variable: watchable ? `${owner.name}.${name}` : null,
    id: `${objectId}/${place.part}/${String(place.line)}:${String(place.column)}`,
    text: name,
    detail,
    icon: ICONS[kind] ?? Variable,
    run: () =>
      openObject(objectId, owner?.name ?? name, {
        place: { ...place, endLine: place.line, endColumn: place.column + name.length },
      }),
  };
}

/** Symbols as entries; `all` of them, or without what is in the list of objects already. */
function symbolItems(found: readonly ProjectSymbol[], objects: readonly ObjectSummary[], all: boolean): PaletteItem[] {
  return found.flatMap((symbol) => {
    const address = parsePartUri(symbol.location.uri);
    const object = objects.find((candidate) => candidate.id === address?.objectId);
    if (address === null || object === undefined) return [];
    if (!all && object.name.toUpperCase() === symbol.name.toUpperCase()) return [];
    const { line, character } = symbol.location.range.start;
    const target = { objectId: object.id, part: address.part, line: line + 1, column: character + 1 };
    return [item(symbol.name, symbol.kind, objectPath(objects, object.id), target, objects)];
  });
}

/** What the texts of one object declare, without the sections around it. */
function memberItems(
  outlines: Readonly<Record<Part, readonly MemberSymbol[]>>,
  objectId: string,
  objects: readonly ObjectSummary[],
): PaletteItem[] {
  const items = new Map<string, PaletteItem>();
  const collect = (part: Part, symbols: readonly MemberSymbol[], section: string) => {
    for (const symbol of symbols) {
      const { line, character } = symbol.selectionRange.start;
      const nested = symbol.children ?? [];
      const isSection = symbol.kind === SECTION && nested.length > 0;
      const owner = objects.find((object) => object.id === objectId)?.name.toUpperCase();
      if (!isSection && symbol.name.toUpperCase() !== owner) {
        const target = { objectId, part, line: line + 1, column: character + 1 };
        const made = item(
          symbol.name,
          symbol.kind,
          [section, symbol.detail].filter(Boolean).join('  '),
          target,
          objects,
        );
        items.set(made.id, made);
      }
      collect(part, nested, isSection ? symbol.name : section);
    }
  };
  collect('declaration', outlines.declaration, '');
  collect('implementation', outlines.implementation, '');
  return [...items.values()];
}

/** Symbols of the project that fit a query; asked for when the typing pauses. */
export function useProjectSymbols(
  projectId: string | null,
  query: string,
  objects: readonly ObjectSummary[],
  all: boolean,
): readonly PaletteItem[] {
  const wanted = query.trim().length >= SHORTEST ? query.trim() : '';
  const [found, setFound] = useState<{ query: string; symbols: readonly ProjectSymbol[] }>({ query: '', symbols: [] });
  useEffect(() => {
    if (projectId === null || wanted === '') return;
    let current = true;
    const timer = setTimeout(() => {
      void symbolSource()
        ?.project(projectId, wanted)
        .then((symbols) => {
          if (current) setFound({ query: wanted, symbols });
        })
        // Without a language server there are objects only.
        .catch(() => undefined);
    }, PAUSE_MS);
    return () => {
      current = false;
      clearTimeout(timer);
    };
  }, [projectId, wanted]);
  return wanted === '' ? [] : symbolItems(found.symbols, objects, all);
}

/** Members of the object whose editor is in front. */
export function useMembers(
  enabled: boolean,
  projectId: string | null,
  objects: readonly ObjectSummary[],
): { object: ObjectSummary | null; items: readonly PaletteItem[] } {
  const [objectId] = useState(() => commandContext().activeEditor?.objectId ?? null);
  const [items, setItems] = useState<readonly PaletteItem[]>([]);
  useEffect(() => {
    if (!enabled || projectId === null || objectId === null) return;
    let current = true;
    const source = symbolSource();
    if (source === null) return;
    void Promise.all([
      source.members(projectId, objectId, 'declaration'),
      source.members(projectId, objectId, 'implementation'),
    ])
      .then(([declaration, implementation]) => {
        if (current) setItems(memberItems({ declaration, implementation }, objectId, objects));
      })
      .catch(() => undefined);
    return () => {
      current = false;
    };
  }, [enabled, projectId, objectId, objects]);
  return { object: objects.find((object) => object.id === objectId) ?? null, items };
}
