/** Values that references give to parameters of their libraries, as data. Pure functions. */
import type { Library, LibraryParameter, LibraryReference, LibrarySummary } from '@/api/types';
import { idOf } from '@/workbench/libraries/model';
import { libraryOf } from './model';

/** A parameter of a library in use; or a value for one that the library does not have. */
export interface ParameterRow {
  key: string;
  /** Index of the reference. */
  at: number;
  library: string;
  /** Empty for a value that does not say which list it is for, and is for none that is there. */
  list: string;
  name: string;
  type: string;
  default: string;
  /** What the reference gives; null: the library's own value holds. */
  value: string | null;
  comment: string;
  /** The library has it; null while its contents are not known. */
  known: boolean | null;
}

const same = (a: string, b: string) => a.toUpperCase() === b.toUpperCase();

/** The libraries whose parameters can have values: those that are referred to and installed, each once. */
export function librariesInUse(
  references: readonly LibraryReference[],
  installed: readonly LibrarySummary[],
): LibrarySummary[] {
  const found = references.flatMap((reference) => libraryOf(reference, installed) ?? []);
  return [...new Map(found.map((library) => [idOf(library), library])).values()];
}

/** Whether a value is for a parameter; one without a list is for the first parameter of its name. */
function isFor(value: LibraryParameter, list: string, name: string): boolean {
  return same(value.name, name) && (!value.list || same(value.list, list));
}

/** All parameters of the libraries in use in the order of the references, then values for what is not there. */
export function parameterRows(
  references: readonly LibraryReference[],
  installed: readonly LibrarySummary[],
  contents: ReadonlyMap<string, Library>,
): ParameterRow[] {
  return references.flatMap((reference, at) => {
    const library = libraryOf(reference, installed);
    const items = library && contents.get(idOf(library))?.items;
    const head = { at, library: reference.placeholder ?? reference.name };
    const left = new Set(reference.parameters ?? []);
    const rows: ParameterRow[] = [];
    for (const { name: list, members } of (items ?? []).filter((item) => item.kind === 'parameter_list')) {
      for (const pin of members) {
        const given = [...left].find((value) => isFor(value, list, pin.name));
        if (given) left.delete(given);
        const { name, type, comment } = pin;
        const value = given?.value ?? null;
        const key = `${at}/${list}.${name}`.toUpperCase();
        rows.push({ ...head, key, list, name, type, default: pin.default, value, comment, known: true });
      }
    }
    for (const { list = '', name, value } of left) {
      const key = `${at}/${list}.${name}?`.toUpperCase();
      const known = library && !items ? null : false;
      rows.push({ ...head, key, list, name, type: '', default: '', value, comment: '', known });
    }
    return rows;
  });
}

/** The reference with another value for a parameter; null: the library's own value holds again. */
export function withValue(reference: LibraryReference, row: ParameterRow, value: string | null): LibraryReference {
  const present = reference.parameters ?? [];
  const at = present.findIndex((one) =>
    row.known ? isFor(one, row.list, row.name) : one.name === row.name && (one.list ?? '') === row.list,
  );
  const fresh = value === null ? [] : [{ list: row.list, name: row.name, value }];
  const parameters = at < 0 ? [...present, ...fresh] : [...present.slice(0, at), ...fresh, ...present.slice(at + 1)];
  const { parameters: _, ...plain } = reference;
  return parameters.length ? { ...plain, parameters } : plain;
}
