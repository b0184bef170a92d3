import { useCallback, useEffect, useRef, useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useBookmarkMarks } from '@/bookmarks/marks';
import { useText } from '@/i18n';
import { languageClient } from '@/lsp/session';
import { useObjectSession } from '@/online/useObjectSession';
import type { EditorProps } from '@/project/editorProps';
import type { OpenText } from '@/text/useTextDocument';
import { OnlineDeclaration } from '../online/OnlineDeclaration';
import { useFaultLine } from '../online/useFaultLine';
import { useOnlineView } from '../online/useOnlineView';
import { setEditorSettings, useEditorSettings, type TextView } from '@/text/settings';
import { CodePane, type CodeEditor } from '@/text/CodePane';
import { addPanelEditor, removePanelEditor } from '@/text/focus';
import { watchable } from '../text/acts';
import { dragsVariables } from '../text/dragVariables';
import { followRightClick, TextMenu } from '../text/TextMenu';
import { useEditingLock } from '../text/useEditingLock';
import { ViewSwitch } from '@/text/ViewSwitch';
import { DeclarationTable } from './DeclarationTable';
import { useShorthand } from './useShorthand';

type DeclarationPaneProps = EditorProps & OpenText & { object: ObjectSummary };

/** The declaration of an object as text or as table; online both show values (DECL-03, DECL-40). */
export function DeclarationPane(props: DeclarationPaneProps) {
  const { object, reveal } = props;
  const t = useText();
  const session = useObjectSession(props.projectId, object);
  const preferred = useEditorSettings((settings) => settings.declarationView);
  // Online the values come first; who looks at the text then has chosen it for this editor only.
  const [onlineView, setOnlineView] = useState<TextView>('table');
  // A jump to a line shows the text until the user chooses again.
  const [dismissed, setDismissed] = useState<number | null>(null);
  const online = session !== null;
  const jump = reveal?.part === 'declaration' && reveal.line !== undefined ? reveal.serial : null;
  const view = jump !== null && jump !== dismissed ? 'text' : online ? onlineView : preferred;

  const choose = (next: TextView) => {
    setDismissed(jump);
    if (online) setOnlineView(next);
    else setEditorSettings({ declarationView: next });
  };
  return (
    <ViewSwitch
      labels={{ group: t('decl.view'), text: t('decl.viewText'), table: t('decl.viewTable') }}
      view={view}
      onView={choose}
    >
      {view === 'text' && <DeclarationText {...props} />}
      {view === 'table' && online && <OnlineDeclaration {...props} session={session} />}
      {view === 'table' && !online && <DeclarationTable {...props} showText={() => choose('text')} />}
    </ViewSwitch>
  );
}

function DeclarationText(props: DeclarationPaneProps) {
  const { panelId, projectId, object, instance, monaco, document } = props;
  const t = useText();
  const latest = useRef({ monaco, document, projectId, object, instance });
  useEffect(() => {
    latest.current = { monaco, document, projectId, object, instance };
  });
  const [editor, setEditor] = useState<CodeEditor | null>(null);
  const readOnly = useEditingLock(object, editor);
  useShorthand(monaco, projectId, editor);
  useOnlineView({ ...props, part: 'declaration', editor });
  useFaultLine(projectId, object, 'declaration', editor);
  useBookmarkMarks(object.id, 'declaration', editor);
  const onEditor = useCallback(
    (made: CodeEditor | null) => {
      if (made === null) removePanelEditor(panelId, 'declaration');
      else {
        addPanelEditor(panelId, 'declaration', made);
        languageClient(monaco, projectId);
        followRightClick(made);
        dragsVariables(made, () => watchable(latest.current, made));
      }
      setEditor(made);
    },
    [panelId, monaco, projectId],
  );
  return (
    <TextMenu panelId={panelId}>
      <CodePane
        monaco={monaco}
        model={document.models.declaration}
        label={t('st.declarationOf', { name: object.name })}
        readOnly={readOnly}
        onEditor={onEditor}
      />
    </TextMenu>
  );
}
