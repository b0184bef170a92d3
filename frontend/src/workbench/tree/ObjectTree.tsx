import { hasRole, opensEditor } from '@/project/kinds';
import { useVirtualizer } from '@tanstack/react-virtual';
import { useEffect, useId, useMemo, useRef, useState, type KeyboardEvent, type MouseEvent } from 'react';
import type { ObjectSummary, PlacementRule } from '@/api/types';
import { t, useText } from '@/i18n';
import { useHandlers } from '../useHandlers';
import { guard } from '@/ui/notices';
import { useOnline } from '../onlineSession';
import { openObject } from '../docking/dock';
import { useProject } from '@/project/openProject';
import { selectObjects, useSelection } from '../selection';
import { toneOfApplication } from '../tones';
import { ContextMenu } from '@/ui/Menu';
import { renameObject } from './acts';
import { pasteInto, treeHandlers } from './handlers';
import {
  findTyped,
  lineage,
  MOTION_OF_KEY,
  moveFocus,
  opensFor,
  rangeOf,
  rowsOf,
  type Forest,
  type Motion,
  type Row,
  type TreeView,
} from '@/project/tree';
import { nameFault } from '@/project/placement';
import { indentOf, TreeRow } from './Row';
import { setExpanded, useTree } from './state';
import { treeEntries } from './treeMenu';
import { isMenuKey, openMenuAt } from '@/ui/menuKey';
import rowStyles from '@/ui/Rows.module.css';
import styles from './Tree.module.css';
import { useDrag } from './useDrag';
import { useMarks } from './useMarks';

const ROW_HEIGHT = 24;
const TYPING_MS = 700;

const MOTIONS: Record<string, Motion> = {
  ...MOTION_OF_KEY,
  PageUp: 'pageUp',
  PageDown: 'pageDown',
};

interface ObjectTreeProps {
  panelId: string;
  projectId: string;
  view: TreeView;
  objects: readonly ObjectSummary[];
  forest: Forest;
  roots: readonly ObjectSummary[];
  rules: readonly PlacementRule[];
  filter: string;
  label: string;
}

/** The tree of one view. One tab stop; the focused row is announced by `aria-activedescendant`, so rows can be virtual. */
export function ObjectTree({
  panelId,
  projectId,
  view,
  objects,
  forest,
  roots,
  rules,
  filter,
  label,
}: ObjectTreeProps) {
  useText();
  const id = useId();
  const scroll = useRef<HTMLDivElement>(null);
  const typed = useRef({ text: '', at: 0 });
  const { expanded, renaming, clipboard, reveal } = useTree();
  const selected = useSelection((state) => state.objectIds);
  const applicationId = useProject((state) => state.applicationId);
  const sessions = useOnline((state) => state.sessions);
  const [focused, setFocused] = useState<string | null>(null);
  const marks = useMarks(objects);
  const anchor = useRef<string | null>(null);
  const rows = useMemo(() => rowsOf(forest, roots, expanded, filter), [forest, roots, expanded, filter]);
  const at = rows.findIndex((row) => row.object.id === focused);
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW_HEIGHT,
    overscan: 15,
    paddingStart: 2,
    paddingEnd: 40,
  });

  const select = (objectId: string, how: 'one' | 'range' | 'toggle' = 'one') => {
    setFocused(objectId);
    if (how === 'range') selectObjects(rangeOf(rows, anchor.current, objectId));
    else {
      anchor.current = objectId;
      if (how === 'one') selectObjects([objectId]);
      else
        selectObjects(
          selected.includes(objectId) ? selected.filter((other) => other !== objectId) : [...selected, objectId],
        );
    }
  };

  /** Selects a row and scrolls it into view: for keys and commands. A click leaves the tree under the pointer still. */
  const goTo = (objectId: string, how?: 'one' | 'range' | 'toggle') => {
    select(objectId, how);
    const index = rows.findIndex((row) => row.object.id === objectId);
    if (index >= 0) virtual.scrollToIndex(index);
  };

  const handlers = useMemo(() => treeHandlers(projectId, view, rules), [projectId, view, rules]);
  useHandlers(panelId, handlers);

  // Something outside (a new object, "show in tree") wants a row in view: open its parents first, then go there.
  const revealed = useRef(0);
  useEffect(() => {
    if (!reveal || reveal.serial === revealed.current || !forest.byId.has(reveal.objectId)) return;
    const closed = opensFor(forest, reveal.objectId).filter((parent) => !expanded.has(parent));
    if (closed.length > 0) {
      setExpanded(closed, true);
      return;
    }
    if (!rows.some((row) => row.object.id === reveal.objectId)) return;
    revealed.current = reveal.serial;

    goTo(reveal.objectId);
    scroll.current?.focus();
  });

  const open = (object: ObjectSummary) => {
    if (opensEditor(object)) openObject(object.id, object.name);
    else setExpanded([object.id], !expanded.has(object.id));
  };

  const onKeyDown = (event: KeyboardEvent) => {
    const motion = MOTIONS[event.key];
    const row = rows[at];
    if (motion && !event.ctrlKey && !event.altKey) {
      event.preventDefault();
      const page = Math.max(1, Math.floor((scroll.current?.clientHeight ?? 240) / ROW_HEIGHT) - 1);
      const move = moveFocus(rows, focused, motion, page);
      if (move.open) setExpanded([move.open], true);
      if (move.close) setExpanded([move.close], false);
      if (move.focus) goTo(move.focus, event.shiftKey ? 'range' : 'one');
    } else if (event.key === 'Enter' && row) {
      event.preventDefault();
      open(row.object);
    } else if (event.key === ' ' && event.ctrlKey && row) {
      event.preventDefault();
      goTo(row.object.id, 'toggle');
    } else if (event.key === '*' && row) {
      setExpanded(
        rows.filter((other) => other.expandable && other.level === row.level).map((other) => other.object.id),
        true,
      );
    } else if (isMenuKey(event)) {
      event.preventDefault();
      openMenuAt(event.currentTarget.querySelector('[data-focused]') ?? event.currentTarget);
    } else if (event.key.length === 1 && !event.ctrlKey && !event.altKey && !event.metaKey && event.key !== ' ') {
      const now = event.timeStamp;
      const text = now - typed.current.at < TYPING_MS ? typed.current.text + event.key : event.key;
      typed.current = { text, at: now };
      const found = findTyped(rows, focused, text);
      if (found) goTo(found);
    }
  };

  const onFocus = () => {
    // Coming in by Tab without a focused row: the selected one, else the first.
    if (at >= 0) return;
    const first = rows.find((row) => selected.includes(row.object.id)) ?? rows[0];
    if (first) setFocused(first.object.id);
  };

  const choose = (event: MouseEvent, row: Row) => {
    const how = event.shiftKey ? 'range' : event.ctrlKey || event.metaKey ? 'toggle' : 'one';
    // A right click on one of several selected rows keeps the selection: its menu acts on all of them.
    if (event.button === 2 && selected.includes(row.object.id)) setFocused(row.object.id);
    else select(row.object.id, how);
  };

  const faultOf = (object: ObjectSummary) => (name: string) => {
    const fault = nameFault(rules, object.kind, forest, object.parent_id, name, object.id);
    return fault && t(fault.key, fault.values);
  };

  const renamed = (object: ObjectSummary, name: string | null) => {
    useTree.setState({ renaming: null });
    scroll.current?.focus();
    if (name !== null) void guard(() => renameObject(projectId, object, name));
  };

  const drag = useDrag({
    projectId,
    view,
    forest,
    rules,
    taken: (objectId) => (selected.includes(objectId) ? selected : [objectId]),
    onMoved: (parentId) => parentId && setExpanded([parentId], true),
  });

  return (
    <ContextMenu entries={() => treeEntries({ view, forest, rules, paste: () => pasteInto(projectId, view, rules) })}>
      <div
        ref={scroll}
        className={`${rowStyles.rows} ${styles.tree}`}
        role="tree"
        aria-label={label}
        aria-multiselectable
        aria-activedescendant={at >= 0 ? `${id}-${rows[at]!.object.id}` : undefined}
        tabIndex={0}
        data-scope="tree"
        data-autofocus
        data-over-root={drag.overRoot ? '' : undefined}
        onKeyDown={onKeyDown}
        onFocus={onFocus}
        onContextMenu={(event) => {
          if (event.target === event.currentTarget) selectObjects([]);
        }}
        onPointerDown={(event) => {
          if (event.target === event.currentTarget) selectObjects([]);
        }}
        onDragOver={drag.overBackground}
        onDrop={drag.drop}
        onDragLeave={drag.leave}
      >
        <div className={styles.body} style={{ height: virtual.getTotalSize() }} role="presentation">
          {virtual.getVirtualItems().map((entry) => {
            const row = rows[entry.index]!;
            const { object } = row;
            const tone = hasRole(object, 'application') ? toneOfApplication(object.id, sessions) : undefined;
            return (
              <div
                key={object.id}
                id={`${id}-${object.id}`}
                role="treeitem"
                aria-level={row.level}
                aria-posinset={row.position}
                aria-setsize={row.siblings}
                aria-expanded={row.expandable ? row.expanded : undefined}
                aria-selected={selected.includes(object.id)}
                data-focused={object.id === focused ? '' : undefined}
                data-cut={clipboard?.cut && clipboard.ids.includes(object.id) ? '' : undefined}
                data-drop={drag.mark?.id === object.id ? drag.mark.where : undefined}
                className={`${rowStyles.row} ${styles.row}`}
                style={
                  {
                    transform: `translateY(${entry.start}px)`,
                    '--indent': `${indentOf(row.level)}px`,
                  } as React.CSSProperties
                }
                draggable={renaming !== object.id}
                onMouseDown={(event) => choose(event, row)}
                onDoubleClick={() => open(object)}
                onDragStart={(event) => drag.start(event, object.id)}
                onDragOver={(event) => drag.over(event, row)}
                onDrop={drag.drop}
                onDragEnd={drag.end}
              >
                <TreeRow
                  row={row}
                  filter={filter.trim()}
                  strong={object.id === applicationId}
                  tone={tone}
                  relation={sessions[object.id]?.relation}
                  mark={marks.get(object.id)}
                  excluded={lineage(forest, object.id).some((one) => one.excluded)}
                  renaming={renaming === object.id}
                  faultOf={faultOf(object)}
                  onTwist={() => setExpanded([object.id], !row.expanded)}
                  onRenamed={(name) => renamed(object, name)}
                />
              </div>
            );
          })}
        </div>
      </div>
    </ContextMenu>
  );
}
