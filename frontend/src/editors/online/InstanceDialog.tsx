import { useQuery } from '@tanstack/react-query';
import { useMemo, useState, type KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import type { SymbolTree } from '@/online/symbols';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { TextInput } from '@/ui/Field';
import { Grid } from '@/ui/grid/Grid';
import { cursorAfterKey } from '@/ui/grid/cursor';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import styles from './InstanceDialog.module.css';

interface InstanceDialogProps {
  /** Function block whose instances are offered. */
  type: string;
  codeId: string | null;
  tree: SymbolTree;
  /** Empty text: the implementation without values. */
  close: (instance?: string) => void;
}

/** Which instance of a function block shall be shown online; equal local names of two instances never mix. */
export function InstanceDialog({ type, codeId, tree, close }: InstanceDialogProps) {
  const t = useText();
  const [typed, setTyped] = useState('');
  const found = useQuery({
    queryKey: ['instances', codeId, type],
    queryFn: async () => [...(await tree.instancesOf(type))],
    staleTime: 60_000,
  });
  const instances = useMemo(
    () => (found.data ?? []).filter((path) => path.toUpperCase().includes(typed.trim().toUpperCase())),
    [found.data, typed],
  );
  const selection = useGridSelection(instances.length);
  const row = selection.cursor?.row ?? 0;
  const chosen = instances[row];
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === 'Enter' && chosen !== undefined) {
      event.preventDefault();
      close(chosen);
      return;
    }
    if (['Home', 'End', 'ArrowLeft', 'ArrowRight'].includes(event.key)) return;
    const next = cursorAfterKey(event.key, event.ctrlKey, { row, column: 0 }, instances.length, 1, 10);
    if (next === null) return;
    event.preventDefault();
    selection.move(next, 'one');
  };
  return (
    <Dialog
      title={t('st.instanceTitle', { type })}
      description={t('st.instanceText')}
      width={520}
      onClose={() => close()}
      footer={
        <>
          <Button style={{ marginRight: 'auto' }} onClick={() => close('')}>
            {t('st.implementationOnly')}
          </Button>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button
            variant="primary"
            disabledReason={chosen === undefined ? t('st.noInstance', { type }) : null}
            onClick={() => close(chosen)}
          >
            {t('st.openInstance')}
          </Button>
        </>
      }
    >
      <div className={styles.chooser}>
        <TextInput
          value={typed}
          onValue={(value) => {
            setTyped(value);
            selection.clear();
          }}
          onKeyDown={onKeyDown}
          placeholder={t('st.searchInstance')}
          aria-label={t('st.searchInstance')}
          data-autofocus
        />
        <div className={styles.list}>
          {found.isPending && <Loading />}
          {found.isError && <Failed error={found.error} retry={() => void found.refetch()} />}
          {found.isSuccess && (
            <Grid
              label={t('st.instanceTitle', { type })}
              columns={[{ id: 'path', title: t('st.instance'), width: 300, grow: true, code: true }]}
              count={instances.length}
              keyOf={(index) => instances[index] ?? ''}
              cell={(index) => <span>{instances[index]}</span>}
              selected={new Set([row])}
              cursor={selection.cursor}
              onCursor={(cursor) => selection.move(cursor, 'one')}
              onEdit={(cell) => close(instances[cell.row])}
              empty={<Empty title={t('st.noInstance', { type })} text={t('st.noInstanceText')} />}
            />
          )}
        </div>
      </div>
    </Dialog>
  );
}
