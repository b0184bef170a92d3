import { useState, type ReactNode } from 'react';
import { useText } from '@/i18n';
import { channelOf } from '@/online/connections';
import { PreparedEditor } from '@/online/PreparedCell';
import { isWritable, togglePrepared } from '@/online/toggle';
import { notify } from '@/ui/notices';
import type { RowValue } from './values';

interface Preparing {
  readonly row: number;
  readonly value: RowValue;
}

interface Prepare {
  /** The value that a literal is being typed for. */
  readonly editing: Preparing | null;
  readonly open: (value: RowValue, row: number) => void;
  readonly editor: () => ReactNode;
}

/** Prepares values for Write and Force from the table: BOOL goes to its next one, others are typed (ONL-05). */
export function usePrepare(runtimeId: string | null): Prepare {
  const t = useText();
  const [editing, setEditing] = useState<Preparing | null>(null);
  const open = (value: RowValue, row: number) => {
    const live = runtimeId === null ? null : channelOf(runtimeId)?.board.get(value.expression);
    if (runtimeId === null || live == null) return;
    if (!isWritable(live.item.flags)) notify({ tone: 'info', title: t('online.constantFixed') });
    else if (!togglePrepared(runtimeId, value.expression)) setEditing({ row, value });
  };
  const editor = () =>
    editing !== null &&
    runtimeId !== null && (
      <PreparedEditor
        runtimeId={runtimeId}
        row={{
          key: editing.value.expression,
          expression: editing.value.expression,
          label: editing.value.name,
          depth: 0,
          root: 0,
          open: undefined,
        }}
        initial={undefined}
        onDone={() => setEditing(null)}
      />
    );
  return { editing: runtimeId === null ? null : editing, open, editor };
}
