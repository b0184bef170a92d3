/** Objects as the API answers them: what is common to all, and the shape of those of one kind. */
import { t } from '@/i18n';
import type { DataOfKind, ObjectOf, ProjectObject } from './types';

type AnyData = ProjectObject['data'];

/** Whether the data of an object have a shape; kinds and roles (`project/kinds`) give such checks. */
export type Check<Data extends AnyData> = (object: ProjectObject) => object is ObjectOf<Data>;

export function ofKind<Kind extends keyof DataOfKind>(kind: Kind): Check<DataOfKind[Kind]> {
  return (object): object is ObjectOf<DataOfKind[Kind]> => object.kind === kind;
}

/** The object in the shape that is expected of it; throws where it has another one. */
export function shaped<Data extends AnyData>(object: ProjectObject, check: Check<Data>): ObjectOf<Data> {
  if (!check(object)) throw new Error(t('object.otherKind', { name: object.name, kind: object.kind }));
  return object;
}

/** A text among the data of an object; empty where objects of its kind have none. */
export function dataText(object: ProjectObject, field: 'declaration' | 'implementation' | 'language'): string {
  const data: Readonly<Record<string, unknown>> = object.data;
  const text = data[field];
  return typeof text === 'string' ? text : '';
}
