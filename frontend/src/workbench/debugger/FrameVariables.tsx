import { useMemo, useState } from 'react';
import type { FrameVariable } from '@/api/types';
import { useText } from '@/i18n';
import { Empty } from '@/ui/Empty';
import { notifyError } from '@/ui/notices';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import styles from '../online/CallStackPanel.module.css';
import { writeVariable } from './acts';
import own from './Debugger.module.css';

/** The variables of a level of the call stack; Enter or a double click writes one. */
export function FrameVariables({ runtimeId, variables }: { runtimeId: string; variables: readonly FrameVariable[] }) {
  const t = useText();
  const [selected, setSelected] = useState<string | null>(null);
  const [written, setWritten] = useState<string | null>(null);
  const columns = useMemo((): Column<FrameVariable>[] => {
    const write = (variable: FrameVariable, value: string) => {
      setWritten(null);
      if (value !== '' && value !== variable.literal) writeVariable(runtimeId, variable, value).catch(notifyError);
    };
    return [
      {
        id: 'name',
        title: t('online.column.expression'),
        width: 160,
        grow: true,
        cell: ({ name, scope }) => <span className={scope === 'local' ? own.local : styles.code}>{name}</span>,
        sort: ({ name }) => name,
      },
      {
        id: 'type',
        title: t('online.column.type'),
        width: 110,
        hint: ({ type }) => type,
        cell: ({ type }) => <span className={styles.code}>{type}</span>,
      },
      {
        id: 'value',
        title: t('online.column.value'),
        width: 140,
        grow: true,
        hint: ({ text }) => text,
        cell: (variable) =>
          written === variable.name ? (
            <input
              className={own.field}
              aria-label={t('debugger.newValue', { name: variable.name })}
              defaultValue={variable.literal}
              autoFocus
              onFocus={(event) => event.target.select()}
              onBlur={() => setWritten(null)}
              onKeyDown={(event) => {
                event.stopPropagation();
                if (event.key === 'Enter') write(variable, event.currentTarget.value.trim());
                else if (event.key === 'Escape') setWritten(null);
              }}
            />
          ) : (
            <span className={styles.code}>{variable.text === '' ? '–' : variable.text}</span>
          ),
      },
    ];
  }, [t, runtimeId, written]);
  return (
    <Table
      label={t('debugger.variables')}
      items={variables}
      columns={columns}
      keyOf={({ name }) => name}
      selected={selected}
      onSelect={(variable) => setSelected(variable?.name ?? null)}
      onOpen={({ name, writable, path, literal }) => {
        if ((writable || path != null) && literal !== '') setWritten(name);
      }}
      empty={<Empty title={t('debugger.noVariables')} text={t('debugger.noVariablesText')} />}
    />
  );
}
