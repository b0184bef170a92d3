import { valuesOf } from '@/project/kinds';
import { Boxes } from 'lucide-react';
import { useCallback, useEffect, useMemo, useRef, useState } from 'react';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { LostBar } from '@/online/LostBar';
import { OnlineTable } from '@/online/OnlineTable';
import online from '@/online/OnlineTable.module.css';
import { commonEntries } from '@/online/rowMenu';
import type { SymbolChild } from '@/online/symbols';
import type { OnlineRoot } from '@/online/treeRows';
import { useSymbols } from '@/online/useLive';
import type { EditorProps } from '@/project/editorProps';
import type { OnlineSession } from '@/workbench/onlineSession';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { useModelText } from '@/text/useModelText';
import type { OpenText } from '@/text/useTextDocument';
import { joinComments } from '@/iec/declaration/comments';
import { parseDeclaration } from '@/iec/declaration/parse';
import type { GridColumn } from '@/ui/grid/Grid';
import { setPanelChosen } from '@/text/focus';
import { chooseInstance } from './chooseInstance';
import { monitorTarget } from './monitorScope';

type OnlineDeclarationProps = EditorProps & OpenText & { object: ObjectSummary; session: OnlineSession };

/** The declaration while logged in: a monitoring table of the shown data (DECL-42 .. DECL-48). */
export function OnlineDeclaration(props: OnlineDeclarationProps) {
  const { panelId, projectId, object, instance, document, session, visible } = props;
  const t = useText();
  const { data: objects } = useObjects(projectId);
  const text = useModelText(document.models.declaration);
  const model = useMemo(() => parseDeclaration(text), [text]);
  const target = useMemo(() => monitorTarget(objects ?? [], object, instance, text), [objects, object, instance, text]);
  const tree = useSymbols(session);
  const members = useMembers(tree, target.path, target.temporary.size > 0 && valuesOf(object) === 'call');

  // An FB that is opened while logged in asks for its instance once.
  const asked = useRef(false);
  const choose = useCallback(() => {
    const type = target.needsInstanceOf;
    if (type === null || tree === null) return false;
    void chooseInstance({ panelId, objectId: object.id, name: object.name, type, tree, session });
    return true;
  }, [target.needsInstanceOf, tree, panelId, object, session]);
  useEffect(() => {
    if (!asked.current && visible) asked.current = choose();
  }, [visible, choose]);

  useEffect(() => () => setPanelChosen(panelId, null), [panelId]);

  const roots = useMemo((): readonly OnlineRoot[] => {
    const rows = model.rows.filter((row) => row.special === null);
    const declared = new Map(rows.map((row, order) => [row.name.text.toUpperCase(), { row, order }]));
    const extra = (name: string) => {
      const row = declared.get(name.toUpperCase())?.row;
      return (
        row && {
          address: row.address?.text,
          comment: joinComments(row.comments.map((cell) => cell.text)),
          section: model.blocks[row.block]?.scope,
        }
      );
    };
    // In the order of the text; inherited variables, which it does not name, come first.
    const order = (child: SymbolChild) => declared.get(child.name.toUpperCase())?.order ?? -1;
    if (members !== null && target.path !== null && valuesOf(object) !== 'call') {
      return [...members]
        .sort((a, b) => order(a) - order(b))
        .map((child) => ({
          ...child,
          key: child.path,
          label: child.name,
          expression: child.path,
          ...extra(child.name),
        }));
    }
    return rows.map((row) => ({
      key: row.name.text,
      label: row.name.text,
      expression: row.name.text,
      type: row.type?.text,
      leaf: true,
      valueless: true,
      section: model.blocks[row.block]?.scope,
      ...extra(row.name.text),
    }));
  }, [model, members, target.path, object]);

  const columns = useMemo(
    (): readonly GridColumn[] => [
      { id: 'expression', title: t('online.column.expression'), width: 200, grow: true },
      { id: 'type', title: t('online.column.type'), width: 140 },
      { id: 'value', title: t('online.column.value'), width: 150, grow: true },
      { id: 'prepared', title: t('online.column.prepared'), width: 120 },
      { id: 'address', title: t('online.column.address'), width: 80, code: true },
      { id: 'comment', title: t('online.column.comment'), width: 180, grow: true },
    ],
    [t],
  );
  return (
    <div className={online.panel}>
      <LostBar session={session} />
      {target.needsInstanceOf !== null && (
        <div className={online.bar}>
          <Boxes size={14} aria-hidden />
          <span style={{ marginRight: 'auto' }}>{t('st.noInstanceChosen')}</span>
          <Button variant="quiet" onClick={choose}>
            {t('st.chooseInstance')}
          </Button>
        </div>
      )}
      {valuesOf(object) === 'call' && <div className={online.bar}>{t('st.stackVariables')}</div>}
      <div>
        <OnlineTable
          label={t('st.declarationOf', { name: object.name })}
          session={session}
          roots={roots}
          columns={columns}
          menu={(rows) => commonEntries(t, session, rows)}
          onFocus={(chosen) => setPanelChosen(panelId, chosen)}
          visible={visible}
          empty={<Empty title={t('decl.empty')} />}
        />
      </div>
    </div>
  );
}

function useMembers(
  tree: ReturnType<typeof useSymbols>,
  path: string | null,
  skip: boolean,
): readonly SymbolChild[] | null {
  const [read, setRead] = useState<{ tree: typeof tree; path: string; children: readonly SymbolChild[] } | null>(null);
  useEffect(() => {
    if (tree === null || path === null || skip) return;
    let current = true;
    tree.children(path).then(
      (children) => current && setRead({ tree, path, children }),
      () => undefined,
    );
    return () => {
      current = false;
    };
  }, [tree, path, skip]);
  return read !== null && read.tree === tree && read.path === path ? read.children : null;
}
