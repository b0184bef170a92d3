import { useEffect, useMemo, useRef } from 'react';
import { useStore } from 'zustand';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { channelOf } from '@/online/connections';
import { useMemberNames, useSymbols } from '@/online/useLive';
import { useObjectSession } from '@/online/useObjectSession';
import type { EditorProps } from '@/project/editorProps';
import type { Part } from '@/project/partUri';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { OpenText } from '@/text/useTextDocument';
import { setPanelPrepare } from '@/text/focus';
import { useEditorSettings } from '@/text/settings';
import type { CodeEditor } from '@/text/CodePane';
import type { Executed } from './executed';
import { InlineMonitor, type MonitorSettings } from './inlineMonitor';
import { monitorTarget } from '@/project/monitorScope';
import { prepareClicked, prepareValue } from './preparePopup';
import { noteRunningText, runningText } from './runningText';
import { unchangedLines } from './staleLines';
import { useExecuted, useExecutedLines } from './useExecuted';
import { usesOf } from './uses';

type MonitoredProps = Pick<EditorProps, 'projectId' | 'instance' | 'visible'> &
  Pick<OpenText, 'document'> & { object: ObjectSummary; part?: Part };

interface Monitored {
  readonly session: OnlineSession | null;
  readonly runtimeId: string | null;
  /** Null while logged out. */
  readonly settings: MonitorSettings | null;
  /** Whether values can be shown. */
  readonly ready: boolean;
  /** Function block whose instance has to be chosen first. */
  readonly needsInstanceOf: string | null;
  /** What flow control says of the body; null without it, and where another text runs. */
  readonly executed: Executed | null;
}

/** What an implementation needs to show its values: where its variables live, and which lines are the running ones. */
export function useMonitored(props: MonitoredProps): Monitored {
  const { projectId, object, instance, document, visible, part = 'implementation' } = props;
  const { data: objects } = useObjects(projectId);
  const session = useObjectSession(projectId, object);
  const runtimeId = session?.runtimeId ?? null;
  const format = useEditorSettings((settings) => settings.numberFormat);
  const declaration = useStore(document.store, (state) => state.text.declaration);
  const implementation = useStore(document.store, (state) => state.text.implementation);
  const stored = useStore(document.store, (state) => state.base.parts.implementation);
  const target = useMemo(
    () => monitorTarget(objects ?? [], object, instance, declaration),
    [objects, object, instance, declaration],
  );
  const members = useMemberNames(useSymbols(session), target.path);

  useEffect(() => {
    if (session !== null) noteRunningText(session, object.id, stored);
  }, [session, object.id, stored]);
  const running = useMemo(() => {
    const text = session === null ? null : runningText(session, object.id);
    return text === null || text === implementation ? null : unchangedLines(text, implementation);
  }, [session, object.id, implementation]);

  const settings = useMemo(
    () =>
      runtimeId === null
        ? null
        : {
            runtimeId,
            scope: { instance: target.path, members, temporary: target.temporary },
            format,
            lost: session?.lostSince != null,
            running,
          },
    [runtimeId, target, members, format, session?.lostSince, running],
  );
  // Without a chosen instance, names of the block would be taken for globals: better no values than wrong ones.
  const ready = settings !== null && target.needsInstanceOf === null && (target.path === null || members !== null);
  const recorded = visible && part === 'implementation' && running === null && session?.past === null;
  const executed = useExecuted({ runtimeId, objectId: object.id, shown: recorded });
  return { session, runtimeId, settings, ready, needsInstanceOf: target.needsInstanceOf, executed };
}

type OnlineViewProps = EditorProps & OpenText & { object: ObjectSummary; part: Part; editor: CodeEditor | null };

/** Values behind the variables of a text while logged in; a click on one prepares a value. */
export function useOnlineView(props: OnlineViewProps): void {
  const { monaco, editor, panelId, part, visible } = props;
  const { runtimeId, settings: monitored, ready, executed } = useMonitored(props);
  useExecutedLines(editor, executed);
  // Which lines run is known of the body; a name is declared in the running program, or has no value.
  const settings = useMemo(
    () => (monitored !== null && part === 'declaration' ? { ...monitored, running: null } : monitored),
    [monitored, part],
  );
  const monitor = useRef<InlineMonitor | null>(null);

  useEffect(() => {
    const channel = channelOf(runtimeId);
    if (editor === null || channel === null || !ready) return;
    const made = new InlineMonitor(monaco, editor, channel, usesOf[part]);
    const mouse = editor.onMouseUp((event) => prepareClicked(monaco, editor, runtimeId ?? '', event));
    setPanelPrepare(panelId, part, () => {
      const place = made.atCursor();
      const position = editor.getPosition();
      if (place === null || position === null) return false;
      prepareValue(monaco, editor, runtimeId ?? '', place.expression, position);
      return true;
    });
    monitor.current = made;
    return () => {
      monitor.current = null;
      setPanelPrepare(panelId, part, null);
      mouse.dispose();
      made.dispose();
    };
  }, [editor, runtimeId, ready, monaco, panelId, part]);

  // After the effect above: a monitor that has just been made gets its settings here.
  useEffect(() => {
    monitor.current?.setVisible(visible);
    if (settings !== null) monitor.current?.set(settings);
  }, [settings, editor, runtimeId, ready, monaco, visible]);
  useEffect(() => {
    monitor.current?.setExecuted(executed);
  }, [executed, editor, runtimeId, ready, monaco]);
}
