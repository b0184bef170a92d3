import type { IDockviewPanelHeaderProps } from 'dockview-react';
import { X } from 'lucide-react';
import { useEffect, useRef, type MouseEvent, type ReactNode } from 'react';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { displayName } from '@/project/objectName';
import { useOnline } from '../onlineSession';
import { usePanel, type PanelRegistration } from '../panels';
import { useProject } from '@/project/openProject';
import { useSelection } from '../selection';
import { ToneDot } from '../online/ToneDot';
import { ContextMenu, type MenuEntry } from '@/ui/Menu';
import { isMenuKey, openMenuAt } from '@/ui/menuKey';
import { applicationOf } from '@/project/tree';
import { toneOfApplication } from '../tones';
import { closeEditors } from './close';
import { panelEntries } from './panelMenu';
import type { EditorParams } from './layout';
import styles from './Tab.module.css';

/** The tab of an editor: icon, name, online state, a dot while unsaved. */
export function EditorTab(props: IDockviewPanelHeaderProps<EditorParams>) {
  const { objectId, instance } = props.params;
  const panelId = props.api.id;
  const projectId = useProject((state) => state.projectId);
  const { data: objects } = useObjects(projectId);
  const dirty = useSelection((state) => state.dirty.has(panelId));
  const sessions = useOnline((state) => state.sessions);
  const object = objects?.find((candidate) => candidate.id === objectId);
  const application = object && objects && applicationOf(objects, object.id);
  const name = object ? displayName(object) : (props.api.title ?? '');
  const tone = application && toneOfApplication(application.id, sessions);
  return (
    <TabFrame
      entries={() => panelEntries(props.containerApi, panelId)}
      onClose={() => void closeEditors([panelId])}
      dirty={dirty}
      title={name}
    >
      <ObjectIcon kind={object?.kind ?? ''} subkind={object?.subkind} name={object?.name} size={15} />
      {tone && <ToneDot tone={tone} />}
      <span className={styles.title} data-gone={objects && !object ? '' : undefined}>
        {name}
      </span>
      {instance && <span className={styles.instance}>{instance}</span>}
    </TabFrame>
  );
}

/** The tab of a tool panel: icon, title, a live count. */
export function ToolTab(props: IDockviewPanelHeaderProps) {
  const t = useText();
  const registration = usePanel(props.api.id);
  const title = registration && t(registration.title, registration.titleValues);
  const { api } = props;
  useEffect(() => {
    // The docking names tab and panel by it for screen readers.
    if (title !== undefined && api.title !== title) api.setTitle(title);
  }, [api, title]);
  if (!registration || title === undefined) return null;
  const Icon = registration.icon;
  return (
    <TabFrame
      entries={() => [
        ...panelEntries(props.containerApi, props.api.id),
        ...(registration.entries ? [{ kind: 'line' as const, key: 'line-own' }, ...registration.entries()] : []),
      ]}
      onClose={() => props.api.close()}
      title={title}
      tool
    >
      <Icon size={14} strokeWidth={1.75} aria-hidden />
      <span className={styles.title}>{title}</span>
      {registration.useBadge && <Badge registration={registration} />}
    </TabFrame>
  );
}

function Badge({ registration }: { registration: PanelRegistration }) {
  const badge = registration.useBadge?.();
  return badge ? (
    <span className={styles.badge} data-tone={badge.tone}>
      {badge.text}
    </span>
  ) : null;
}

interface TabFrameProps {
  title: string;
  dirty?: boolean;
  /** Tool tabs show their cross only while they are in front. */
  tool?: boolean;
  onClose: () => void;
  entries: () => readonly MenuEntry[];
  children: ReactNode;
}

function TabFrame({ title, dirty, tool, onClose, entries, children }: TabFrameProps) {
  const t = useText();
  const middleClick = (event: MouseEvent) => {
    if (event.button === 1) onClose();
  };
  const frame = useRef<HTMLDivElement>(null);
  useEffect(() => {
    // The focus is on the tab of the docking around this frame.
    const tab = frame.current?.closest<HTMLElement>('.dv-tab');
    const onKey = (event: KeyboardEvent) => {
      if (frame.current === null || !isMenuKey(event)) return;
      event.preventDefault();
      openMenuAt(frame.current);
    };
    tab?.addEventListener('keydown', onKey);
    return () => tab?.removeEventListener('keydown', onKey);
  }, []);
  return (
    <ContextMenu entries={entries}>
      <div ref={frame} className={styles.tab} data-tool={tool ? '' : undefined} title={title} onAuxClick={middleClick}>
        {children}
        {/* For the mouse: a tab holds no other control; the keyboard closes it by a command (Window menu). */}
        <span
          className={styles.close}
          data-dirty={dirty ? '' : undefined}
          title={t('tab.close', { name: title })}
          aria-hidden
          onPointerDown={(event) => event.stopPropagation()}
          onClick={(event) => {
            event.stopPropagation();
            onClose();
          }}
        >
          <span className={styles.dot} />
          <X className={styles.cross} size={13} />
        </span>
      </div>
    </ContextMenu>
  );
}
