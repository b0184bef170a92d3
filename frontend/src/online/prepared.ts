/** Values prepared for Write (Ctrl+F7) and Force (F7): one store for pills, tables, watch lists (WAT-07). */
import { create } from 'zustand';
import { expressionKey, type PlcValue } from './item';

export interface PreparedValue {
  readonly expression: string;
  /** IEC literal as it will be sent. */
  readonly literal: string;
}

interface PreparedState {
  /** By runtime, then by expression key. */
  readonly values: Readonly<Record<string, Readonly<Record<string, PreparedValue>>>>;
}

export const usePrepared = create<PreparedState>(() => ({ values: {} }));

/** Prepares a value; null takes it back. */
export function prepare(runtimeId: string, expression: string, literal: string | null): void {
  const key = expressionKey(expression);
  usePrepared.setState(({ values }) => {
    const { [key]: _old, ...rest } = values[runtimeId] ?? {};
    const next = literal === null ? rest : { ...rest, [key]: { expression, literal } };
    return { values: { ...values, [runtimeId]: next } };
  });
}

/** The open field in which a value to prepare is being typed. */
let openField: (() => boolean) | null = null;

/** A field for a value to prepare has opened; null when it closes. What is typed in it is taken before a write. */
export function setOpenField(take: (() => boolean) | null): void {
  openField = take;
  usePrepared.setState(({ values }) => ({ values: { ...values } }));
}

export function hasOpenField(): boolean {
  return openField !== null;
}

/** Takes what is typed into the open field, if there is one; false when it is refused: the field says why. */
export function takeOpenField(): boolean {
  return openField === null || openField();
}

export function preparedLiteral(runtimeId: string | null, expression: string): string | null {
  if (runtimeId === null) return null;
  return usePrepared.getState().values[runtimeId]?.[expressionKey(expression)]?.literal ?? null;
}

export function preparedValues(runtimeId: string): readonly PreparedValue[] {
  return Object.values(usePrepared.getState().values[runtimeId] ?? {});
}

/** Takes back what was prepared: all, or the given ones after they were written. */
export function clearPrepared(runtimeId: string, written?: readonly PreparedValue[]): void {
  usePrepared.setState(({ values }) => {
    const now = { ...values[runtimeId] };
    if (written === undefined) return { values: { ...values, [runtimeId]: {} } };
    for (const value of written) {
      const key = expressionKey(value.expression);
      // A value typed again while the old one was on its way stays prepared.
      if (now[key]?.literal === value.literal) delete now[key];
    }
    return { values: { ...values, [runtimeId]: now } };
  });
}

/**
 * The next prepared value when a BOOL is toggled (DECL-44): with TRUE now FALSE, TRUE, none; with FALSE now
 * TRUE, FALSE, none.
 */
export function toggledLiteral(current: PlcValue | null, prepared: string | null): string | null {
  const first = current === true ? 'FALSE' : 'TRUE';
  const second = current === true ? 'TRUE' : 'FALSE';
  if (prepared === null) return first;
  return prepared === first ? second : null;
}

/** Subscribes a component to the prepared literal of one expression. */
export function usePreparedLiteral(runtimeId: string | null, expression: string): string | null {
  const key = expressionKey(expression);
  return usePrepared((state) => (runtimeId === null ? null : (state.values[runtimeId]?.[key]?.literal ?? null)));
}
