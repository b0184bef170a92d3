import { Play } from 'lucide-react';
import { useCallback, useEffect, useMemo, useRef, useState } from 'react';
import { ofKind } from '@/api/objects';
import type { DataOfKind } from '@/api/types';
import { useDraft, type Draft } from '@/editors/form/useDraft';
import { plainTextHandlers } from '@/editors/text/actions';
import { useText } from '@/i18n';
import type { EditorProps } from '@/project/editorProps';
import { runScript, useScriptRun } from '@/scripts/runner';
import { addPanelEditor, removePanelEditor } from '@/text/focus';
import { CodePane, type CodeEditor } from '@/text/CodePane';
import { loadMonaco, type Monaco } from '@/text/monacoLoader';
import { Button } from '@/ui/Button';
import { Failed, Loading } from '@/ui/Empty';
import { guard } from '@/ui/notices';
import styles from './Script.module.css';

type ScriptData = DataOfKind['script'];

/** The server's limit. */
const MOST_CHARACTERS = 256 * 1024;
/** Letters typed one after the other are one change. */
const TYPING_MS = 400;

/** The text of a script, and the button that runs it. */
export default function ScriptEditor(props: EditorProps) {
  const { panelId, projectId, objectId } = props;
  const t = useText();
  const [monaco, setMonaco] = useState<Monaco | null>(null);
  const [error, setError] = useState<unknown>(null);
  const handlers = useMemo(() => plainTextHandlers(panelId), [panelId]);
  const draft = useDraft(panelId, projectId, objectId, ofKind('script'), fits, handlers);
  const running = useScriptRun((state) => state.run?.state === 'running');
  useEffect(() => {
    loadMonaco().then(setMonaco, setError);
  }, []);
  const failed = error ?? (draft.object ? null : draft.error);
  if (failed) return <Failed error={failed} />;
  if (!monaco || !draft.object || !draft.data) return <Loading />;
  const tooLong = !fits(draft.data);
  return (
    <div className={styles.editor}>
      <div className={styles.bar}>
        <Button
          icon={Play}
          disabledReason={running ? t('scripts.runs') : tooLong ? t('script.tooLong', { most: MOST_CHARACTERS }) : null}
          onClick={() => void guard(() => runScript(projectId, objectId))}
        >
          {t('script.run')}
        </Button>
        <span className={styles.note}>{draft.readOnly ?? t('script.note')}</span>
        {(draft.refused ?? tooLong) && (
          <span className={styles.refused} role="alert">
            {draft.refused ?? t('script.tooLong', { most: MOST_CHARACTERS })}
          </span>
        )}
      </div>
      <ScriptText {...props} monaco={monaco} draft={draft} />
    </div>
  );
}

function fits({ text }: ScriptData): boolean {
  return text.length <= MOST_CHARACTERS;
}

function ScriptText(props: EditorProps & { monaco: Monaco; draft: Draft<ScriptData> }) {
  const { panelId, projectId, objectId, reveal, monaco, draft } = props;
  const t = useText();
  const { text } = draft.data!;
  const [editor, setEditor] = useState<CodeEditor | null>(null);
  const model = useMemo(() => {
    const uri = monaco.Uri.parse(`tappet-script:/${projectId}/${objectId}`);
    return monaco.editor.getModel(uri) ?? monaco.editor.createModel(text, 'javascript', uri);
    // The text of later versions comes by the effect below.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [monaco, projectId, objectId]);
  const latest = useRef(draft);
  /** What was typed and handed on last: it comes back as the data of the draft. */
  const known = useRef(text);
  useEffect(() => {
    latest.current = draft;
  });

  useEffect(() => {
    if (text === known.current) return;
    known.current = text;
    if (model.getValue() !== text)
      model.pushEditOperations([], [{ range: model.getFullModelRange(), text }], () => null);
  }, [model, text]);
  useEffect(() => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    const handOn = () => {
      clearTimeout(timer);
      timer = undefined;
      const typed = model.getValue();
      if (typed === known.current) return;
      known.current = typed;
      latest.current.change({ ...latest.current.data!, text: typed });
    };
    const typing = model.onDidChangeContent(() => {
      clearTimeout(timer);
      timer = setTimeout(handOn, TYPING_MS);
    });
    const blur = editor?.onDidBlurEditorText(handOn);
    return () => {
      if (timer !== undefined) handOn();
      typing.dispose();
      blur?.dispose();
    };
  }, [model, editor]);
  useEffect(() => {
    if (editor === null || reveal === null) return;
    if (reveal.line !== undefined) {
      editor.setPosition({ lineNumber: reveal.line, column: reveal.column ?? 1 });
      editor.revealLineInCenterIfOutsideViewport(reveal.line);
    }
    if (reveal.focus) editor.focus();
  }, [editor, reveal]);

  const onEditor = useCallback(
    (made: CodeEditor | null) => {
      if (made === null) removePanelEditor(panelId, 'implementation');
      else addPanelEditor(panelId, 'implementation', made);
      setEditor(made);
    },
    [panelId],
  );
  return (
    <div className={styles.text}>
      <CodePane
        monaco={monaco}
        model={model}
        label={t('script.textOf', { name: draft.object!.name })}
        readOnly={draft.readOnly !== null}
        onEditor={onEditor}
      />
    </div>
  );
}
