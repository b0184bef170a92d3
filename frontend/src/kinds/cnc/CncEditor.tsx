import { useEffect, useMemo, useRef, useState } from 'react';
import { useStore } from 'zustand';
import { ofKind } from '@/api/objects';
import { useObject } from '@/api/queries';
import type { ObjectOf } from '@/api/types';
import { DocumentBars } from '@/editors/documents/DocumentBars';
import { OnlineEditBar } from '@/editors/text/OnlineEditBar';
import { useEditingLock } from '@/editors/text/useEditingLock';
import { useReveal } from '@/editors/text/useReveal';
import { Splitter } from '@/editors/textObject/Splitter';
import { useText } from '@/i18n';
import type { EditorProps } from '@/project/editorProps';
import { phaseOf } from '@/text/documentState';
import type { CodeEditor } from '@/text/CodePane';
import { useTextDocument, type OpenText } from '@/text/useTextDocument';
import { Failed, Loading } from '@/ui/Empty';
import { useHandlers } from '@/workbench/useHandlers';
import { setDirty } from '@/workbench/selection';
import styles from './Cnc.module.css';
import { CncGrid } from './CncGrid';
import { CncText } from './CncText';
import { CncToolbar, type CncView } from './CncToolbar';
import { openProgram, type CncDocument } from './cncDocument';
import { registerCncLanguage } from './language';
import { CNC_TEXT } from './languageName';
import { PathPane } from './path/PathPane';
import { conditionsOf, startOf, type CncProgramData } from './properties';
import { useCncActs, type CncScene } from './useCncActs';

/** A CNC program as text, as table, or both (cnc.md sections 2 and 3): views of one model with one undo stack. */
export default function CncEditor(props: EditorProps) {
  const { projectId, objectId } = props;
  const { data: object, error } = useObject(projectId, objectId, ofKind('cnc'));
  const text = useTextDocument(projectId, objectId);
  if (error && !object) return <Failed error={error} />;
  if (text.status === 'failed') return <Failed error={text.error} retry={text.retry} />;
  if (text.status === 'loading' || !object) return <Loading />;
  return <OpenCnc {...props} monaco={text.monaco} document={text.document} object={object} />;
}

type Opened = EditorProps & OpenText & { object: ObjectOf<CncProgramData> };

/** The program in the model of the text, under the properties of the object. */
function useProgram({ monaco, document, object }: Opened): CncDocument {
  const model = document.models.implementation;
  const program = useMemo(() => {
    registerCncLanguage(monaco);
    // The text may have been opened, by a search for instance, before the language was known.
    monaco.editor.setModelLanguage(model, CNC_TEXT);
    return openProgram(monaco, model);
  }, [monaco, model]);
  const { data } = object;
  const latest = useRef(data);
  useEffect(() => {
    latest.current = data;
  });
  const key = JSON.stringify([conditionsOf(data), startOf(data), data.offline_values]);
  useEffect(() => {
    const names = latest.current.offline_values.map(({ name }) => name);
    program.under(conditionsOf(latest.current), startOf(latest.current), names);
  }, [program, key]);
  return program;
}

function OpenCnc(props: Opened) {
  const { panelId, projectId, objectId, document, monaco, object, reveal, visible } = props;
  const t = useText();
  const program = useProgram(props);
  const [view, setView] = useState<CncView>(object.data.view);
  const [line, setLine] = useState(0);
  const [editor, setEditor] = useState<CodeEditor | null>(null);
  const locked = useEditingLock(object, editor);
  const changed = useStore(document.store, (state) => phaseOf(state) !== 'clean');
  const [share, setShare] = useState(0.5);
  const [graphic, setGraphic] = useState(true);
  const [above, setAbove] = useState(0.4);
  const scene = useRef<CncScene | null>(null);
  useEffect(() => {
    setDirty(panelId, changed);
    return () => setDirty(panelId, false);
  }, [panelId, changed]);
  useEffect(() => {
    scene.current = { projectId, objectId, name: object.name, program, document, line, data: object.data };
  });
  const acts = useCncActs(panelId, scene, locked);
  useHandlers(panelId, acts);
  useReveal(panelId, reveal);
  // A place to go to is one of the text.
  const [seen, setSeen] = useState(reveal?.serial);
  if (reveal?.serial !== seen) {
    setSeen(reveal?.serial);
    if (view === 'table') setView('both');
  }

  const text = view !== 'table' && (
    <CncText
      key="text"
      panelId={panelId}
      monaco={monaco}
      program={program}
      name={object.name}
      readOnly={locked}
      line={line}
      follows={view === 'both' || graphic}
      onLine={setLine}
      onEditor={setEditor}
    />
  );
  const table = view !== 'text' && (
    <CncGrid
      key="table"
      panelId={panelId}
      projectId={projectId}
      objectId={objectId}
      name={object.name}
      program={program}
      locked={locked}
      line={line}
      onLine={setLine}
    />
  );
  const written =
    text && table ? <Splitter top={text} bottom={table} share={share} onShare={setShare} /> : text || table;
  const path = (
    <PathPane
      projectId={projectId}
      objectId={objectId}
      program={program}
      data={object.data}
      changed={changed}
      locked={locked}
      visible={visible}
      line={line}
      onLine={setLine}
    />
  );
  return (
    <div className={styles.page} aria-label={t('cnc.editorOf', { name: object.name })}>
      <CncToolbar
        acts={acts}
        view={view}
        onView={setView}
        graphic={graphic}
        onGraphic={setGraphic}
        program={program}
        data={object.data}
      />
      <DocumentBars monaco={monaco} document={document} />
      <OnlineEditBar object={object} />
      <div className={styles.panes}>
        {graphic ? <Splitter top={written} bottom={path} share={above} onShare={setAbove} /> : written}
      </div>
    </div>
  );
}
