import { useQuery, useQueryClient } from '@tanstack/react-query';
import { Trash2 } from 'lucide-react';
import { useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Failed, Loading } from '@/ui/Empty';
import { guard } from '@/ui/notices';
import { useCommandContext } from '@/workbench/useCommandContext';
import { atLeast } from '@/workbench/rights';
import { act, sourcePath } from './data/source';
import { tracesQuery } from './data/useRuns';
import styles from './Trace.module.css';

/** The traces that the controller has, with what each does (TRC-04, TRC-72). */
export function OnlineListDialog({ runtimeId, close }: { runtimeId: string; close: () => void }) {
  const t = useText();
  const queries = useQueryClient();
  const operator = atLeast(useCommandContext().role, 'operator');
  const { data, error } = useQuery(tracesQuery(runtimeId));
  const remove = (name: string) =>
    guard(async () => {
      await act('delete', sourcePath({ kind: 'running', runtimeId, name }));
      await queries.invalidateQueries({ queryKey: tracesQuery(runtimeId).queryKey });
      await queries.invalidateQueries({ queryKey: ['trace', runtimeId, name] });
    });
  const content = () => {
    if (error && !data) return <Failed error={error} />;
    if (!data) return <Loading />;
    if (data.length === 0) return <p className={styles.note}>{t('trace.onlineNone')}</p>;
    return (
      <table className={styles.table}>
        <thead>
          <tr>
            <th>{t('trace.onlineName')}</th>
            <th>{t('trace.state')}</th>
            <th>{t('trace.samples')}</th>
            <th>{t('trace.downloadedBy')}</th>
            <th />
          </tr>
        </thead>
        <tbody>
          {data.map((one) => (
            <tr key={one.name}>
              <th>{`${one.application}.${one.name}`}</th>
              <td data-text>{[...new Set(one.records.map(({ state }) => t(`trace.state.${state}`)))].join(', ')}</td>
              <td>{one.records.map(({ samples }) => samples).join(', ')}</td>
              <td data-text>{one.downloaded_by}</td>
              <td>
                <IconButton
                  icon={Trash2}
                  small
                  label={t('trace.removeOnline', { name: one.name })}
                  disabledReason={operator ? null : t('reason.operator')}
                  onClick={() => void remove(one.name)}
                />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    );
  };
  return (
    <Dialog
      title={t('trace.onlineList')}
      description={t('trace.onlineText')}
      width={720}
      onClose={close}
      footer={<Button onClick={close}>{t('action.close')}</Button>}
    >
      {content()}
    </Dialog>
  );
}
