import { valuesOf } from '@/project/kinds';
import { Boxes } from 'lucide-react';
import { useCallback, useEffect, useMemo, useRef, useState } from 'react';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useBookmarkedLines } from '@/bookmarks/marks';
import { useText } from '@/i18n';
import { LostBar } from '@/online/LostBar';
import { OnlineTable, type OnlineTableHandle } from '@/online/OnlineTable';
import online from '@/online/OnlineTable.module.css';
import { commonEntries } from '@/online/rowMenu';
import type { SymbolChild } from '@/online/symbols';
import type { OnlineRoot, OnlineRow } from '@/online/treeRows';
import { useSymbols } from '@/online/useLive';
import { actOnSymbol, type SymbolActs } from '@/workbench/symbolActs';
import { goToDefinition } from '@/lsp/definition';
import type { EditorProps } from '@/project/editorProps';
import type { OnlineSession } from '@/workbench/onlineSession';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import type { MenuEntry } from '@/ui/Menu';
import { useModelText } from '@/text/useModelText';
import { useRowPlace } from '@/text/useRowPlace';
import type { OpenText } from '@/text/useTextDocument';
import { joinComments } from '@/iec/declaration/comments';
import { rowsInLines } from '@/iec/declaration/lines';
import type { DeclarationModel } from '@/iec/declaration/model';
import { parseDeclaration } from '@/iec/declaration/parse';
import type { GridColumn } from '@/ui/grid/Grid';
import { setPanelChosen, setPanelTable } from '@/text/focus';
import { useRegistry } from '@/workbench/commands';
import { commandContext } from '@/workbench/context';
import { entriesOf } from '@/workbench/frame/menuEntries';
import { showCrossReferencesAt } from '../crossReferences/place';
import { chooseInstance } from './chooseInstance';
import { monitorTarget } from '@/project/monitorScope';

type OnlineDeclarationProps = EditorProps & OpenText & { object: ObjectSummary; session: OnlineSession };

/** The declaration while logged in: a monitoring table of the shown data (DECL-42 .. DECL-48). */
export function OnlineDeclaration(props: OnlineDeclarationProps) {
  const { panelId, projectId, object, instance, document, monaco, session, visible } = props;
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

  const lines = useBookmarkedLines({ objectId: object.id, part: 'declaration' });
  const bookmarked = useMemo(() => rowsInLines(model, lines), [model, lines]);
  const table = useRef<OnlineTableHandle>(null);
  const place = useRowPlace({
    monaco,
    document,
    model,
    cursor: () => {
      const at = table.current?.cursor();
      return { row: at == null ? undefined : declaredRow(model, at.row), column: at?.column };
    },
    focus: () => table.current?.focus(),
  });
  useEffect(
    () => () => {
      setPanelChosen(panelId, null);
      setPanelTable(panelId, null);
    },
    [panelId],
  );
  const onFocus = (chosen: () => readonly string[]) => {
    setPanelChosen(panelId, chosen);
    // Components and inherited variables are declared elsewhere: they are known by their expression.
    const onSymbol = (act: keyof SymbolActs, there: () => Promise<void>) => {
      const row = table.current?.cursor()?.row;
      if (place.getPosition() !== null) return there();
      if (row !== undefined && row.expression !== '') actOnSymbol(act, row.expression);
    };
    setPanelTable(panelId, {
      // Values are shown, no text is changed: there is nothing to undo here, and the body beside it is not meant.
      undo: () => undefined,
      redo: () => undefined,
      place,
      acts: {
        'st.goToDefinition': () => onSymbol('goToDefinition', () => goToDefinition(place)),
        'st.crossReferences': () => onSymbol('showCrossReferences', () => showCrossReferencesAt(projectId, place)),
      },
    });
  };
  const menu = (rows: readonly OnlineRow[]): MenuEntry[] => [
    ...commonEntries(t, session, rows),
    ...(place.getPosition() === null
      ? []
      : [
          { kind: 'line', key: 'bookmark-line' } as const,
          ...entriesOf(['bookmarks.toggle'], useRegistry.getState().commands, commandContext()),
        ]),
  ];

  const roots = useMemo((): readonly OnlineRoot[] => {
    const rows = model.rows.flatMap((row, index) =>
      row.special === null ? [{ ...row, bookmarked: bookmarked.has(index) }] : [],
    );
    const declared = new Map(rows.map((row, order) => [row.name.text.toUpperCase(), { row, order }]));
    const extra = (name: string) => {
      const row = declared.get(name.toUpperCase())?.row;
      return (
        row && {
          address: row.address?.text,
          comment: joinComments(row.comments.map((cell) => cell.text)),
          section: model.blocks[row.block]?.scope,
          bookmarked: row.bookmarked,
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
  }, [model, bookmarked, members, target.path, object]);

  const columns = useMemo(
    (): readonly GridColumn[] => [
      { id: 'expression', title: t('online.column.expression'), width: 200, grow: true },
      { id: 'type', title: t('online.column.type'), width: 170 },
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
          handle={table}
          label={t('st.declarationOf', { name: object.name })}
          session={session}
          roots={roots}
          columns={columns}
          menu={menu}
          onFocus={onFocus}
          visible={visible}
          empty={<Empty title={t('decl.empty')} />}
        />
      </div>
    </div>
  );
}

/** Where the text declares what a row shows; undefined for components and inherited variables. */
function declaredRow(model: DeclarationModel, { depth, label }: OnlineRow): number | undefined {
  if (depth > 0) return undefined;
  const found = model.rows.findIndex(
    ({ special, name }) => special === null && name.text.toUpperCase() === label.toUpperCase(),
  );
  return found < 0 ? undefined : found;
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
