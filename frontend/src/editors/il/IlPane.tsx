import { useEffect, useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import type { EditorProps } from '@/project/editorProps';
import type { OpenText } from '@/text/useTextDocument';
import type { TextView } from '@/text/settings';
import { panelEditorOf, panelPlace } from '@/text/focus';
import { ImplementationPane } from '../text/ImplementationPane';
import { ViewSwitch } from '@/text/ViewSwitch';
import { IlTable } from './IlTable';
import { ilSettings } from './settings';

type IlPaneProps = EditorProps & OpenText & { object: ObjectSummary };

/** A body in Instruction List, as table or as text. */
export function IlPane(props: IlPaneProps) {
  const { panelId } = props;
  const t = useText();
  const preferred = ilSettings.use((settings) => settings.view);
  useEffect(() => void ilSettings.load(), []);
  // An act that only the text editor knows shows the text, in this editor and until the user chooses again.
  const [act, setAct] = useState<{ action: string; line: number; column: number } | null>(null);
  const view = act === null ? preferred : 'text';

  useEffect(() => {
    if (act === null) return;
    let frame = 0;
    const run = () => {
      const editor = panelEditorOf(panelId, 'implementation');
      if (editor === null) {
        frame = requestAnimationFrame(run);
        return;
      }
      editor.setPosition({ lineNumber: act.line, column: act.column });
      editor.revealLineInCenterIfOutsideViewport(act.line);
      editor.focus();
      editor.trigger('command', act.action, null);
    };
    frame = requestAnimationFrame(run);
    return () => cancelAnimationFrame(frame);
  }, [act, panelId]);

  const choose = (next: TextView) => {
    setAct(null);
    ilSettings.change({ view: next });
  };
  const inText = (action: string) => {
    const { lineNumber: line, column } = panelPlace(panelId)?.getPosition() ?? { lineNumber: 1, column: 1 };
    setAct({ action, line, column });
  };
  return (
    <ViewSwitch
      labels={{ group: t('il.view'), text: t('il.viewText'), table: t('il.viewTable') }}
      view={view}
      onView={choose}
    >
      {view === 'text' ? <ImplementationPane {...props} /> : <IlTable {...props} inText={inText} />}
    </ViewSwitch>
  );
}
