import { useEffect, useMemo, useRef } from 'react';
import { useStore } from 'zustand';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { channelOf } from '@/online/connections';
import { useMemberNames, useSymbols } from '@/online/useLive';
import { useObjectSession } from '@/online/useObjectSession';
import type { EditorProps } from '@/workbench/editors';
import type { OpenText } from '../documents/useTextDocument';
import { useEditorSettings } from '../settings';
import type { CodeEditor } from '../st/CodePane';
import { InlineMonitor } from './inlineMonitor';
import { monitorTarget } from './monitorScope';
import { openPreparePopup } from './preparePopup';
import { noteRunningText, runningText } from './runningText';
import { unchangedLines } from './staleLines';

type OnlineViewProps = EditorProps & OpenText & { object: ObjectSummary; editor: CodeEditor | null };

/** Values behind the variables of an implementation while logged in; a click on one prepares a value. */
export function useOnlineView({ projectId, object, instance, monaco, document, editor }: OnlineViewProps): void {
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
  const monitor = useRef<InlineMonitor | null>(null);

  useEffect(() => {
    const channel = channelOf(runtimeId);
    if (editor === null || channel === null || !ready) return;
    const made = new InlineMonitor(monaco, editor, channel);
    const mouse = editor.onMouseUp((event) => openPreparePopup(monaco, editor, runtimeId ?? '', event));
    monitor.current = made;
    return () => {
      monitor.current = null;
      mouse.dispose();
      made.dispose();
    };
  }, [editor, runtimeId, ready, monaco]);

  // After the effect above: a monitor that has just been made gets its settings here.
  useEffect(() => {
    if (settings !== null) monitor.current?.set(settings);
  }, [settings, editor, runtimeId, ready, monaco]);
}
