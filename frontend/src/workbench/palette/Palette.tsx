import { ChevronRight, Hash, ListTree, Search } from 'lucide-react';
import { Dialog as Radix } from 'radix-ui';
import { useId, useMemo, useRef, useState, type KeyboardEvent } from 'react';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useText, type TextKey } from '@/i18n';
import { rowAfterKey } from '@/ui/table';
import type { IconComponent } from '@/icons/IconComponent';
import { useRegistry } from '../commands';
import { commandContext } from '../context';
import { dragOut } from '../expressionDrag';
import { useProject } from '@/project/openProject';
import { commandItems, objectItems, type PaletteItem } from './items';
import { search } from './match';
import line from '@/ui/SearchLine.module.css';
import styles from './Palette.module.css';
import { closePalette, usePalette, type PaletteMode } from './state';
import { useMembers, useProjectSymbols } from './symbols';

const SHOWN = 80;
const NAMES: Readonly<Record<PaletteMode, TextKey>> = {
  commands: 'command.palette',
  symbols: 'command.goToSymbol',
  members: 'palette.members',
  objects: 'command.quickOpen',
};
const PREFIX: Readonly<Record<PaletteMode, string>> = { commands: '>', symbols: '#', members: '@', objects: '' };
const MODE_ICONS = { commands: ChevronRight, symbols: Hash, members: ListTree, objects: Search };
const NO_OBJECTS: readonly ObjectSummary[] = [];

/** What is looked for, by the first character. */
function modeOf(text: string): PaletteMode {
  const prefixed = (['commands', 'symbols', 'members'] as const).find((mode) => text.startsWith(PREFIX[mode]));
  return prefixed ?? 'objects';
}

/**
 * The command palette and quick open: one field, one list. A `>` at the beginning changes to commands, a `#` to the
 * symbols of the project, an `@` to what the active object declares. Quick open finds objects first, then the members
 * of all of them.
 */
export function Palette() {
  const mode = usePalette((state) => state.mode);
  return mode && <OpenPalette key={mode} initial={mode} />;
}

function OpenPalette({ initial }: { initial: PaletteMode }) {
  const t = useText();
  const id = useId();
  const list = useRef<HTMLDivElement>(null);
  const [text, setText] = useState(PREFIX[initial]);
  const [at, setAt] = useState(0);
  const mode = modeOf(text);
  const query = text.slice(PREFIX[mode].length);
  const commands = useRegistry((state) => state.commands);
  const projectId = useProject((state) => state.projectId);
  const { data } = useObjects(projectId);
  const objects = data ?? NO_OBJECTS;
  const asksProject = mode === 'objects' || mode === 'symbols';
  const symbols = useProjectSymbols(projectId, asksProject ? query : '', objects, mode === 'symbols');
  const members = useMembers(mode === 'members', projectId, objects);
  const items = useMemo(() => {
    if (mode === 'commands') return commandItems(commands.values(), commandContext());
    if (mode === 'objects') return objectItems(objects);
    if (mode === 'symbols') return [];
    const below = objects.filter((object) => object.parent_id === members.object?.id);
    return [...members.items, ...objectItems(members.object === null ? [] : below)];
  }, [mode, commands, objects, members]);
  const hits = useMemo(
    () => [items, symbols].flatMap((entries) => search(query, entries, (item) => item.text)).slice(0, SHOWN),
    [query, items, symbols],
  );
  const name = t(NAMES[mode]);
  const hint = t(`palette.${mode}`);

  const ModeIcon = MODE_ICONS[mode];
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
          <Radix.Title className="visually-hidden">{name}</Radix.Title>
          <div className={`${line.search} ${styles.search}`}>
            <ModeIcon size={16} aria-hidden />
            <input
              role="combobox"
              aria-expanded
              aria-controls={id}
              aria-activedescendant={hits[at] ? `${id}-${at}` : undefined}
              aria-label={hint}
              placeholder={hint}
              value={query}
              spellCheck={false}
              onChange={(event) => {
                setText(`${PREFIX[mode]}${event.target.value}`);
                setAt(0);
              }}
              onKeyDown={(event) => {
                if (mode !== 'objects' && query === '' && event.key === 'Backspace') setText('');
                else onKeyDown(event);
              }}
            />
          </div>
          <div ref={list} id={id} role="listbox" aria-label={name} className={styles.list}>
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
      onMouseDown={(event) => {
        const home = event.currentTarget.closest('[role="dialog"]');
        const { variable } = item;
        if (event.button !== 0 || home === null || variable == null) return;
        dragOut({ home, expressions: () => [variable], onLeave: () => closePalette() });
      }}
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
