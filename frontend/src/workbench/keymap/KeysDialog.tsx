import { Download, RotateCcw, Upload } from 'lucide-react';
import { useMemo, useRef, useState, type KeyboardEvent } from 'react';
import { listed, useText } from '@/i18n';
import { notify } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Empty } from '@/ui/Empty';
import { Field, Select, TextInput } from '@/ui/Field';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { useRegistry, type Command } from '../commands';
import { saveBlob } from '../downloadFile';
import { keyOfEvent, keysText, sameKeys } from '../keys';
import { titleOf } from '../run';
import styles from './KeysDialog.module.css';
import {
  choosePreset,
  conflicts,
  giveKeys,
  keymapOfFile,
  replaceKeymap,
  resetKeys,
  soundKeymap,
  useKeymap,
} from './keymap';
import { PRESETS, type Preset } from './presets';

/** The keys of all commands: look them up, change them, take over those of another system. */
export function KeysDialog({ close }: { close: () => void }) {
  const t = useText();
  const commands = useRegistry((state) => state.commands);
  const keymap = useKeymap();
  const { preset, own } = useMemo(() => soundKeymap(keymap), [keymap]);
  const [search, setSearch] = useState('');
  const [selected, setSelected] = useState<string | null>(null);
  const [pressed, setPressed] = useState<string | null>(null);
  const file = useRef<HTMLInputElement>(null);
  const shown = useMemo(() => {
    const wanted = search.trim().toLowerCase();
    const texts = (command: Command) =>
      [titleOf(command), ...(command.keys ?? []).flatMap((keys) => [keys, keysText(keys)])].join(' ').toLowerCase();
    return [...commands.values()]
      .filter((command) => !wanted || texts(command).includes(wanted))
      .sort((a, b) => titleOf(a).localeCompare(titleOf(b)));
  }, [commands, search]);
  const chosen = selected === null ? undefined : commands.get(selected);
  const taken = chosen && pressed !== null ? conflicts(commands.values(), chosen, pressed) : [];

  const columns: Column<Command>[] = [
    {
      id: 'command',
      title: t('shortcuts.command'),
      width: 240,
      grow: true,
      sort: titleOf,
      cell: (command) => <span>{titleOf(command)}</span>,
    },
    {
      id: 'keys',
      title: t('shortcuts.keys'),
      width: 210,
      sort: (command) => command.keys?.[0] ?? '',
      cell: (command) => (
        <span className={command.id in own ? styles.own : undefined}>
          {(command.keys ?? []).map((keys) => keysText(keys)).join(', ')}
        </span>
      ),
    },
  ];

  const select = (id: string | null) => {
    setSelected(id);
    setPressed(null);
  };
  const onPress = (event: KeyboardEvent) => {
    // Tab and Escape alone stay what they are: the way out.
    if (!event.ctrlKey && !event.altKey && !event.metaKey && ['Tab', 'Escape', 'Enter'].includes(event.key)) return;
    event.preventDefault();
    event.stopPropagation();
    const keys = keyOfEvent(event);
    if (keys !== null) setPressed(keys);
  };
  const assign = () => {
    if (!chosen || pressed === null) return;
    for (const other of taken)
      giveKeys(
        other.id,
        (other.keys ?? []).filter((keys) => !sameKeys(keys, pressed)),
      );
    giveKeys(chosen.id, [pressed, ...(chosen.keys ?? []).filter((keys) => !sameKeys(keys, pressed))]);
    setPressed(null);
  };
  const importFile = async (given: File | undefined) => {
    if (!given) return;
    try {
      replaceKeymap(keymapOfFile(await given.text()));
    } catch {
      notify({ tone: 'error', title: t('shortcuts.noKeymap'), text: given.name });
    }
  };
  const exportFile = () =>
    saveBlob(new Blob([`${JSON.stringify({ preset, own }, null, 2)}\n`], { type: 'application/json' }), 'keys.json');

  return (
    <Dialog
      title={t('command.shortcuts')}
      width={640}
      onClose={close}
      footer={
        <>
          <Button icon={Upload} onClick={() => file.current?.click()}>
            {t('shortcuts.import')}
          </Button>
          <Button icon={Download} onClick={exportFile}>
            {t('shortcuts.export')}
          </Button>
          <Button
            icon={RotateCcw}
            disabledReason={Object.keys(own).length === 0 ? t('shortcuts.nothingChanged') : null}
            onClick={() => replaceKeymap({ preset, own: {} })}
          >
            {t('shortcuts.resetAll')}
          </Button>
          <span className={styles.grow} />
          <Button onClick={close}>{t('action.close')}</Button>
        </>
      }
    >
      <input
        ref={file}
        type="file"
        accept=".json,application/json"
        hidden
        aria-label={t('shortcuts.import')}
        onChange={(event) => {
          void importFile(event.target.files?.[0]);
          event.target.value = '';
        }}
      />
      <Field row label={t('shortcuts.preset')}>
        {(attributes) => (
          <Select<Preset>
            {...attributes}
            value={preset}
            choices={PRESETS.map((value) => ({ value, text: t(`shortcuts.preset.${value}`) }))}
            onValue={choosePreset}
          />
        )}
      </Field>
      <TextInput
        data-autofocus
        value={search}
        onValue={setSearch}
        placeholder={t('shortcuts.search')}
        aria-label={t('shortcuts.search')}
      />
      <div className={styles.table}>
        <Table
          label={t('command.shortcuts')}
          items={shown}
          columns={columns}
          keyOf={(command) => command.id}
          selected={selected}
          onSelect={(command) => select(command?.id ?? null)}
          empty={<Empty title={t('palette.none')} />}
        />
      </div>
      {chosen ? (
        <div className={styles.change}>
          <TextInput
            readOnly
            className={styles.press}
            value={pressed === null ? '' : keysText(pressed)}
            placeholder={t('shortcuts.press', { command: titleOf(chosen) })}
            aria-label={t('shortcuts.press', { command: titleOf(chosen) })}
            onKeyDown={onPress}
          />
          <Button disabledReason={pressed === null ? t('shortcuts.pressFirst') : null} onClick={assign}>
            {t('shortcuts.assign')}
          </Button>
          <Button
            disabledReason={chosen.keys?.length ? null : t('shortcuts.noKeys')}
            onClick={() => giveKeys(chosen.id, [])}
          >
            {t('shortcuts.remove')}
          </Button>
          <Button
            disabledReason={chosen.id in own ? null : t('shortcuts.nothingChanged')}
            onClick={() => resetKeys(chosen.id)}
          >
            {t('shortcuts.reset')}
          </Button>
        </div>
      ) : (
        <div className={styles.hint}>{t('shortcuts.choose')}</div>
      )}
      {taken.length > 0 && (
        <div className={styles.conflict} role="alert">
          {t('shortcuts.conflict', { commands: listed(taken.map(titleOf)) })}
        </div>
      )}
    </Dialog>
  );
}
