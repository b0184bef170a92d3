import { useMemo, useState } from 'react';
import { useText } from '@/i18n';
import { useRegistry, type Command } from '../commands';
import { keysText } from '../keys';
import { titleOf } from '../run';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Empty } from '@/ui/Empty';
import { TextInput } from '@/ui/Field';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';

/** Every command that has a key. */
export function ShortcutsDialog({ close }: { close: () => void }) {
  const t = useText();
  const commands = useRegistry((state) => state.commands);
  const [search, setSearch] = useState('');
  const [selected, setSelected] = useState<string | null>(null);
  const shown = useMemo(() => {
    const wanted = search.trim().toLowerCase();
    return [...commands.values()]
      .filter((command) => command.keys?.length && !command.hidden)
      .filter((command) => !wanted || `${titleOf(command)} ${command.keys!.join(' ')}`.toLowerCase().includes(wanted))
      .sort((a, b) => titleOf(a).localeCompare(titleOf(b)));
  }, [commands, search]);
  const columns: Column<Command>[] = [
    {
      id: 'command',
      title: t('shortcuts.command'),
      width: 220,
      grow: true,
      sort: titleOf,
      cell: (command) => <span>{titleOf(command)}</span>,
    },
    {
      id: 'keys',
      title: t('shortcuts.keys'),
      width: 190,
      sort: (command) => command.keys![0]!,
      cell: (command) => <span>{command.keys!.map((keys) => keysText(keys)).join(', ')}</span>,
    },
  ];
  return (
    <Dialog
      title={t('command.shortcuts')}
      width={560}
      onClose={close}
      footer={<Button onClick={close}>{t('action.close')}</Button>}
    >
      <TextInput
        data-autofocus
        value={search}
        onValue={setSearch}
        placeholder={t('messages.search')}
        aria-label={t('messages.search')}
      />
      <div style={{ height: 360, border: '1px solid var(--line)', borderRadius: 'var(--radius)', overflow: 'hidden' }}>
        <Table
          label={t('command.shortcuts')}
          items={shown}
          columns={columns}
          keyOf={(command) => command.id}
          selected={selected}
          onSelect={(command) => setSelected(command?.id ?? null)}
          empty={<Empty title={t('palette.none')} />}
        />
      </div>
    </Dialog>
  );
}
