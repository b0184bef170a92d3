import { useRef, type DragEvent, type KeyboardEvent, type MouseEvent } from 'react';
import { Eye, EyeOff } from 'lucide-react';
import { useText } from '@/i18n';
import { ContextMenu, type MenuEntry } from '@/ui/Menu';
import { droppedLines } from '@/workbench/expressionDrag';
import { channelName, nodeKey, nodesBetween, nodesOf, sameNode, type Node, type TraceData } from './configuration';
import { automaticColor } from './diagram/ink';
import styles from './Trace.module.css';

interface TraceTreeProps {
  data: TraceData;
  nodes: readonly Node[];
  onNodes: (nodes: readonly Node[]) => void;
  menu: () => readonly MenuEntry[];
  onOpen: (node: Node) => void;
  onVisible: (nodes: readonly Node[]) => void;
  onDelete?: () => void;
  onDrop?: (record: number, variables: readonly string[]) => void;
  /** Records as what they do now. */
  states?: readonly (string | null)[];
  /** The controller records now. */
  active?: boolean;
  faulty: ReadonlySet<string>;
  label: string;
}

/** Records and their variables (TRC-01): choice of several, Enter opens the settings, Space shows and hides. */
export function TraceTree(props: TraceTreeProps) {
  const { data, nodes, onNodes, menu, onOpen, onVisible, onDelete, onDrop, states, active, faulty, label } = props;
  const t = useText();
  const list = useRef<HTMLDivElement>(null);
  const all = nodesOf(data);
  const last = nodes.at(-1) ?? null;
  const anchor = useRef<Node | null>(null);
  const choose = (node: Node, event: { shiftKey: boolean; ctrlKey: boolean; metaKey: boolean }) => {
    if (event.shiftKey && anchor.current) {
      onNodes([...nodesBetween(data, anchor.current, node).filter((one) => !sameNode(one, node)), node]);
      return;
    }
    anchor.current = node;
    if (!event.ctrlKey && !event.metaKey) onNodes([node]);
    else if (nodes.some((one) => sameNode(one, node))) onNodes(nodes.filter((one) => !sameNode(one, node)));
    else onNodes([...nodes, node]);
  };
  const go = (node: Node | undefined, event: KeyboardEvent) => {
    if (node === undefined) return;
    choose(node, { shiftKey: event.shiftKey, ctrlKey: false, metaKey: false });
    list.current?.querySelector(`[data-node="${nodeKey(node)}"]`)?.scrollIntoView({ block: 'nearest' });
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const at = last === null ? -1 : all.findIndex((one) => sameNode(one, last));
    const acts: Record<string, () => void> = {
      ArrowDown: () => go(all[Math.min(all.length - 1, at + 1)], event),
      ArrowUp: () => go(all[Math.max(0, at - 1)], event),
      Home: () => go(all[0], event),
      End: () => go(all.at(-1), event),
      Enter: () => last && onOpen(last),
      ' ': () => onVisible(nodes),
      Delete: () => onDelete?.(),
    };
    const act = event.ctrlKey && event.key === 'a' ? () => onNodes(all) : acts[event.key];
    if (act === undefined) return;
    event.preventDefault();
    act();
  };
  const drop = (event: DragEvent, record: number) => {
    event.preventDefault();
    event.stopPropagation();
    onDrop?.(record, droppedLines(event.dataTransfer).expressions);
  };
  const droppable = (record: number) =>
    onDrop && {
      onDragOver: (event: DragEvent) => {
        event.preventDefault();
        event.dataTransfer.dropEffect = 'copy';
      },
      onDrop: (event: DragEvent) => drop(event, record),
    };
  const row = (node: Node, event: MouseEvent) => ({
    ...(nodes.some((one) => sameNode(one, node)) ? {} : choose(node, event)),
  });
  return (
    <ContextMenu entries={menu}>
      <div
        ref={list}
        className={styles.tree}
        role="tree"
        aria-label={label}
        aria-multiselectable
        aria-activedescendant={last ? `trace-node-${nodeKey(last)}` : undefined}
        tabIndex={0}
        onKeyDown={onKeyDown}
        {...droppable(Math.max(0, last?.record ?? 0))}
      >
        {all.map((node) => {
          const record = data.records[node.record]!;
          const key = nodeKey(node);
          const selected = nodes.some((one) => sameNode(one, node));
          const common = {
            id: `trace-node-${key}`,
            role: 'treeitem',
            'aria-selected': selected,
            'data-node': key,
            'data-faulty': faulty.has(key) || undefined,
            onClick: (event: MouseEvent) => choose(node, event),
            onContextMenu: (event: MouseEvent) => void row(node, event),
            onDoubleClick: () => onOpen(node),
            ...droppable(node.record),
          };
          if (node.channel === null) {
            return (
              <div key={key} {...common} aria-level={1} className={styles.recordRow}>
                <span className={styles.name}>{record.name}</span>
                {states?.[node.record] && (
                  <span className={styles.recordState} data-active={active || undefined}>
                    {states[node.record]}
                  </span>
                )}
              </div>
            );
          }
          const channel = record.channels[node.channel]!;
          const Sign = channel.visible ? Eye : EyeOff;
          const name = channelName(channel) || t('trace.noVariable');
          return (
            <div key={key} {...common} aria-level={2} className={styles.channelRow} data-hidden={!channel.visible}>
              <i style={{ background: channel.color || automaticColor(node.channel) }} />
              <span className={`${styles.name} code`} title={name}>
                {name}
              </span>
              <button
                type="button"
                className={styles.eye}
                tabIndex={-1}
                aria-label={t('trace.visibleOf', { name })}
                aria-pressed={channel.visible}
                onClick={(event) => {
                  event.stopPropagation();
                  onVisible([node]);
                }}
              >
                <Sign size={14} aria-hidden />
              </button>
            </div>
          );
        })}
      </div>
    </ContextMenu>
  );
}
