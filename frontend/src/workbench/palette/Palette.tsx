import { ChevronRight, Search } from 'lucide-react';
import { Dialog as Radix } from 'radix-ui';
import { useId, useMemo, useRef, useState, type KeyboardEvent } from 'react';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { rowAfterKey } from '../ui/table';
import type { IconComponent } from '../types';
import { useRegistry } from '../commands';
import { commandContext } from '../context';
import { useProject } from '../project';
import { commandItems, objectItems, type PaletteItem } from './items';
import { search } from './match';
import styles from './Palette.module.css';
import { closePalette, usePalette, type PaletteMode } from './state';

const SHOWN = 80;

/** The command palette and quick open: one field, one list. A `>` at the beginning changes to commands. */
export function Palette() {
  const mode = usePalette((state) => state.mode);
  return mode && <OpenPalette key={mode} initial={mode} />;
}

function OpenPalette({ initial }: { initial: PaletteMode }) {
  const t = useText();
  const id = useId();
  const list = useRef<HTMLDivElement>(null);
  const [text, setText] = useState(initial === 'commands' ? '>' : '');
  const [at, setAt] = useState(0);
  const commandMode = text.startsWith('>');
  const query = commandMode ? text.slice(1) : text;
  const commands = useRegistry((state) => state.commands);
  const projectId = useProject((state) => state.projectId);
  const { data: objects } = useObjects(projectId);
  const items = useMemo(
    () => (commandMode ? commandItems(commands.values(), commandContext()) : objectItems(objects ?? [])),
    [commandMode, commands, objects],
  );
  const hits = useMemo(() => search(query, items, (item) => item.text).slice(0, SHOWN), [query, items]);

  const choose = (item: PaletteItem | undefined) => {
    if (!item || item.disabledReason) return;
    closePalette(item.run);
  };

  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === 'Enter') {
      event.preventDefault();
      choose(hits[at]?.entry);
      return;
    }
    const next = event.key === 'Home' || event.key === 'End' ? null : rowAfterKey(event.key, at, hits.length, 10);
    if (next === null) return;
    event.preventDefault();
    const wrapped =
      event.key === 'ArrowDown' && at === hits.length - 1
        ? 0
        : event.key === 'ArrowUp' && at === 0
          ? hits.length - 1
          : next;
    setAt(wrapped);
    list.current?.children[wrapped]?.scrollIntoView({ block: 'nearest' });
  };

  return (
    <Radix.Root open onOpenChange={(open) => !open && closePalette()}>
      <Radix.Portal>
        <Radix.Overlay className={styles.scrim} />
        <Radix.Content className={styles.palette} aria-describedby="">
          <Radix.Title className="visually-hidden">
            {t(commandMode ? 'command.palette' : 'command.quickOpen')}
          </Radix.Title>
          <div className={styles.search}>
            {commandMode ? <ChevronRight size={16} aria-hidden /> : <Search size={16} aria-hidden />}
            <input
              role="combobox"
              aria-expanded
              aria-controls={id}
              aria-activedescendant={hits[at] ? `${id}-${at}` : undefined}
              aria-label={t(commandMode ? 'palette.commands' : 'palette.objects')}
              placeholder={t(commandMode ? 'palette.commands' : 'palette.objects')}
              value={commandMode ? query : text}
              spellCheck={false}
              onChange={(event) => {
                setText(commandMode ? `>${event.target.value}` : event.target.value);
                setAt(0);
              }}
              onKeyDown={(event) => {
                if (commandMode && query === '' && event.key === 'Backspace') setText('');
                else onKeyDown(event);
              }}
            />
          </div>
          <div
            ref={list}
            id={id}
            role="listbox"
            aria-label={t(commandMode ? 'command.palette' : 'command.quickOpen')}
            className={styles.list}
          >
            {hits.map(({ entry, match }, index) => (
              <Entry
                key={entry.id}
                id={`${id}-${index}`}
                item={entry}
                marks={match.at}
                chosen={index === at}
                onEnter={() => setAt(index)}
                onChoose={() => choose(entry)}
              />
            ))}
            {hits.length === 0 && <div className={styles.none}>{t('palette.none')}</div>}
          </div>
        </Radix.Content>
      </Radix.Portal>
    </Radix.Root>
  );
}

interface EntryProps {
  id: string;
  item: PaletteItem;
  marks: readonly number[];
  chosen: boolean;
  onEnter: () => void;
  onChoose: () => void;
}

function Entry({ id, item, marks, chosen, onEnter, onChoose }: EntryProps) {
  const Icon: IconComponent | undefined = item.icon;
  return (
    <div
      id={id}
      role="option"
      aria-selected={chosen}
      aria-disabled={item.disabledReason ? true : undefined}
      className={styles.entry}
      onPointerMove={onEnter}
      onClick={onChoose}
    >
      {Icon ? <Icon size={16} strokeWidth={1.6} /> : <span style={{ width: 16 }} />}
      <span className={styles.text}>
        {[...item.text].map((letter, index) => (marks.includes(index) ? <b key={index}>{letter}</b> : letter))}
      </span>
      <span className={styles.detail}>{item.disabledReason ?? item.detail}</span>
      {item.keys && <span className={styles.keys}>{item.keys}</span>}
    </div>
  );
}
