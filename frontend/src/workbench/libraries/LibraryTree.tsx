import { kindOfSubkind, kindWithRole } from '@/project/kinds';
import { useId, useRef, useState, type KeyboardEvent } from 'react';
import type { LibraryItem, LibrarySummary } from '@/api/types';
import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { findTyped, MOTION_OF_KEY, moveFocus, type Row } from '@/project/tree';
import { Twist } from '@/ui/Twist';
import { groupsOf, idOf } from './model';
import rowStyles from '@/ui/Rows.module.css';
import styles from './Libraries.module.css';
import { useContents } from './useLibraries';

interface Node {
  id: string;
  level: number;
  name: string;
  detail?: string;
  kind: 'library' | 'group' | 'item' | 'required';
  expandable: boolean;
  library: LibrarySummary;
  item?: LibraryItem;
}

interface LibraryTreeProps {
  label: string;
  libraries: readonly LibrarySummary[];
  search?: string;
  /** Show the contents of a single library without a node for the library itself. */
  flat?: boolean;
  onChoose: (library: LibrarySummary, item: LibraryItem | null) => void;
  onOpen?: (library: LibrarySummary, item: LibraryItem | null) => void;
}

/** Libraries in their versions, what they require, folders by kind, items. */
export function LibraryTree({ label, libraries, search = '', flat, onChoose, onOpen }: LibraryTreeProps) {
  const t = useText();
  const id = useId();
  const tree = useRef<HTMLDivElement>(null);
  const [open, setOpen] = useState<ReadonlySet<string>>(() => new Set(flat ? libraries.map(idOf) : []));
  const [focused, setFocused] = useState<string | null>(null);
  const searching = search.trim() !== '';
  const wanted = libraries.filter((library) => searching || flat || open.has(idOf(library)));
  const contents = useContents(wanted);

  const nodes: Node[] = [];
  for (const library of libraries) {
    const libraryId = idOf(library);
    const loaded = contents.get(libraryId);
    const groups = loaded ? groupsOf(loaded, search) : [];
    if (searching && loaded && groups.length === 0) continue;
    const base = flat ? 0 : 1;
    if (!flat)
      nodes.push({
        id: libraryId,
        level: 1,
        name: library.name,
        detail: library.version,
        kind: 'library',
        expandable: true,
        library,
      });
    if (!(searching || flat || open.has(libraryId))) continue;
    if (!searching && library.requires.length > 0) {
      const requiresId = `${libraryId}/requires`;
      nodes.push({
        id: requiresId,
        level: base + 1,
        name: t('libraries.requires'),
        detail: String(library.requires.length),
        kind: 'group',
        expandable: true,
        library,
      });
      if (open.has(requiresId))
        for (const required of library.requires)
          nodes.push({
            id: `${requiresId}/${required.name}`,
            level: base + 2,
            name: required.name,
            detail: required.version === '*' ? t('library.newest') : required.version,
            kind: 'required',
            expandable: false,
            library,
          });
    }
    for (const { group, items } of groups) {
      const groupId = `${libraryId}/${group}`;
      nodes.push({
        id: groupId,
        level: base + 1,
        name: t(`libraryGroup.${group}`),
        detail: String(items.length),
        kind: 'group',
        expandable: true,
        library,
      });
      if (!searching && !open.has(groupId)) continue;
      for (const item of items)
        nodes.push({
          id: `${groupId}/${item.name}`,
          level: base + 2,
          name: item.name,
          detail: item.summary,
          kind: 'item',
          expandable: false,
          library,
          item,
        });
    }
  }
  const isOpen = (node: Node) => node.expandable && (searching || open.has(node.id));
  const toggle = (nodeId: string, expanded: boolean) => {
    const next = new Set(open);
    if (expanded) next.add(nodeId);
    else next.delete(nodeId);
    setOpen(next);
  };
  const goTo = (node: Node | undefined) => {
    if (!node) return;
    setFocused(node.id);
    onChoose(node.library, node.item ?? null);
    requestAnimationFrame(() =>
      tree.current?.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: 'nearest' }),
    );
  };

  const onKeyDown = (event: KeyboardEvent) => {
    const rows = nodes.map((node) => ({
      object: node,
      level: node.level,
      expandable: node.expandable,
      expanded: isOpen(node),
      position: 1,
      siblings: 1,
    })) as unknown as Row[];
    const motion = MOTION_OF_KEY[event.key];
    const node = nodes.find((candidate) => candidate.id === focused);
    if (motion && !event.ctrlKey && !event.altKey) {
      event.preventDefault();
      const move = moveFocus(rows, focused, motion);
      if (move.open) toggle(move.open, true);
      if (move.close) toggle(move.close, false);
      goTo(nodes.find((candidate) => candidate.id === move.focus));
    } else if (event.key === 'Enter' && node) {
      event.preventDefault();
      if (node.expandable) toggle(node.id, !isOpen(node));
      else onOpen?.(node.library, node.item ?? null);
    } else if (event.key.length === 1 && !event.ctrlKey && !event.altKey) {
      const found = findTyped(rows, focused, event.key);
      goTo(nodes.find((candidate) => candidate.id === found));
    }
  };

  return (
    <div
      ref={tree}
      className={rowStyles.rows}
      role="tree"
      aria-label={label}
      tabIndex={0}
      aria-activedescendant={focused ? `${id}-${focused}` : undefined}
      onKeyDown={onKeyDown}
    >
      {nodes.map((node) => (
        <div
          key={node.id}
          id={`${id}-${node.id}`}
          role="treeitem"
          aria-level={node.level}
          aria-expanded={node.expandable ? isOpen(node) : undefined}
          aria-selected={node.id === focused}
          className={rowStyles.row}
          style={{ paddingLeft: 4 + (node.level - 1) * 14 }}
          title={node.kind === 'item' ? node.detail : undefined}
          onMouseDown={() => goTo(node)}
          onDoubleClick={() =>
            node.expandable ? toggle(node.id, !isOpen(node)) : onOpen?.(node.library, node.item ?? null)
          }
        >
          <Twist
            open={isOpen(node)}
            expandable={node.expandable}
            onClick={() => node.expandable && toggle(node.id, !isOpen(node))}
            onDoubleClick={(event) => event.stopPropagation()}
          />
          <NodeIcon node={node} />
          <span>{node.name}</span>
          {node.detail && <span className={styles.muted}>{node.detail}</span>}
        </div>
      ))}
    </div>
  );
}

function NodeIcon({ node }: { node: Node }) {
  const { kind, subkind } = node.item
    ? kindOfSubkind(node.item.kind)
    : { kind: kindWithRole(node.kind === 'group' ? 'folder' : 'libraries')?.kind ?? '', subkind: null };
  return <ObjectIcon kind={kind} subkind={subkind} style={{ flex: 'none' }} />;
}
