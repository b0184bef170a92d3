import { useCallback, useEffect, useMemo, useRef, useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useBookmarkMarks } from '@/bookmarks/marks';
import { useText } from '@/i18n';
import { languageClient } from '@/lsp/session';
import type { EditorProps } from '@/project/editorProps';
import type { OpenText } from '@/text/useTextDocument';
import { useBreakpoints } from '../online/useBreakpoints';
import { useFaultLine } from '../online/useFaultLine';
import { useOnlineView } from '../online/useOnlineView';
import { CodePane, type CodeEditor } from '@/text/CodePane';
import { addPanelEditor, removePanelEditor } from '@/text/focus';
import { watchable } from './acts';
import { dragsVariables } from './dragVariables';
import { followRightClick, TextMenu } from './TextMenu';
import { useAutoDeclare } from './useAutoDeclare';
import { useEditingLock } from './useEditingLock';

/** The ST text of the body, with values behind the variables while online. */
export function ImplementationPane(props: EditorProps & OpenText & { object: ObjectSummary }) {
  const { panelId, projectId, object, instance, monaco, document } = props;
  const t = useText();
  const [editor, setEditor] = useState<CodeEditor | null>(null);
  const readOnly = useEditingLock(object, editor);
  const panel = useMemo(
    () => ({ monaco, document, projectId, object, instance }),
    [monaco, document, projectId, object, instance],
  );
  const latest = useRef(panel);
  useEffect(() => {
    latest.current = panel;
  });
  const onEditor = useCallback(
    (made: CodeEditor | null) => {
      if (made === null) removePanelEditor(panelId, 'implementation');
      else {
        addPanelEditor(panelId, 'implementation', made);
        languageClient(monaco, projectId);
        followRightClick(made);
        dragsVariables(made, () => watchable(latest.current, made));
      }
      setEditor(made);
    },
    [panelId, monaco, projectId],
  );
  useAutoDeclare(panel, editor);
  useOnlineView({ ...props, part: 'implementation', editor });
  useFaultLine(projectId, object, 'implementation', editor);
  useBreakpoints(projectId, object, 'implementation', editor);
  useBookmarkMarks(object.id, 'implementation', editor);
  return (
    <TextMenu panelId={panelId}>
      <CodePane
        monaco={monaco}
        model={document.models.implementation}
        label={t('st.implementationOf', { name: object.name })}
        readOnly={readOnly}
        onEditor={onEditor}
      />
    </TextMenu>
  );
}
