import { channelOf } from './connections';
import { valueKind } from './item';
import { refusePast } from './past/refuse';
import { prepare, preparedLiteral, toggledLiteral } from './prepared';

/** Whether a variable may be written at all: constants that the compiler replaced may not (DECL-47). */
export function isWritable(flags: readonly string[] | undefined): boolean {
  return !(flags ?? []).includes('CONSTANT');
}

/** Takes a BOOL to its next prepared value (DECL-44); false when the variable is none. */
export function togglePrepared(runtimeId: string, expression: string): boolean {
  const live = channelOf(runtimeId)?.board.get(expression) ?? null;
  if (live === null || valueKind(live.item) !== 'bool') return false;
  if (refusePast(runtimeId)) return true;
  if (isWritable(live.item.flags)) {
    prepare(runtimeId, expression, toggledLiteral(live.value, preparedLiteral(runtimeId, expression)));
  }
  return true;
}
