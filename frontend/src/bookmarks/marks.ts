/** Bookmarks in texts: they follow what is typed, and are drawn beside their lines. */
import type { editor } from 'monaco-editor/editor/editor.api';
import { useEffect, useMemo } from 'react';
import { t, useLanguage } from '@/i18n';
import type { Part } from '@/project/partUri';
import type { CodeEditor } from '@/text/CodePane';
import type { TextDocument } from '@/text/documents';
import { followed, relocated, type Lines, type TextPart } from './model';
import { linesOf, moveBookmarks, useBookmarks } from './store';
import styles from './marks.module.css';

const PARTS = ['declaration', 'implementation'] as const;

interface Followed {
  views: number;
  stop: () => void;
}

/** Documents of which an editor is open; all its views share one text. */
const documents = new Map<TextDocument, Followed>();

/** While a view shows a document, its bookmarks go with their lines. */
export function useFollowedBookmarks(document: TextDocument): void {
  useEffect(() => {
    const known = documents.get(document) ?? { views: 0, stop: follow(document) };
    documents.set(document, known);
    known.views += 1;
    return () => {
      known.views -= 1;
      if (known.views > 0) return;
      known.stop();
      documents.delete(document);
    };
  }, [document]);
}

function follow({ objectId, models }: TextDocument): () => void {
  const findAll = () => {
    for (const part of PARTS)
      moveBookmarks((bookmarks) => relocated(bookmarks, { objectId, part }, modelLines(models[part])));
  };
  findAll();
  const unsubscribe = useBookmarks.subscribe((now, before) => {
    if (now.loaded && !before.loaded) findAll();
  });
  const changes = PARTS.map((part) =>
    models[part].onDidChangeContent(({ changes, isFlush }) => {
      const of = { objectId, part };
      const lines = modelLines(models[part]);
      moveBookmarks((bookmarks) =>
        isFlush ? relocated(bookmarks, of, lines) : followed(bookmarks, of, changes, lines),
      );
    }),
  );
  return () => {
    unsubscribe();
    changes.forEach((subscription) => subscription.dispose());
  };
}

function modelLines(model: editor.ITextModel): Lines {
  return { count: model.getLineCount(), line: (number) => model.getLineContent(number) };
}

/** The lines of a part that have a bookmark, for tables that draw the text. */
export function useBookmarkedLines({ objectId, part }: TextPart): readonly number[] {
  const lines = useBookmarks(({ bookmarks }) => linesOf(bookmarks, { objectId, part }));
  return useMemo(() => (lines === '' ? [] : lines.split(',').map(Number)), [lines]);
}

/** Marks in the margin of a text editor. */
export function useBookmarkMarks(objectId: string, part: Part, editor: CodeEditor | null): void {
  const lines = useBookmarkedLines({ objectId, part });
  const language = useLanguage();
  useEffect(() => {
    if (editor === null || lines.length === 0) return;
    const marks = editor.createDecorationsCollection(
      lines.map((line) => ({
        range: { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: 1 },
        options: {
          isWholeLine: true,
          marginClassName: styles.mark,
          lineNumberHoverMessage: { value: t('bookmarks.bookmark') },
          overviewRuler: { color: { id: 'editorInfo.foreground' }, position: 1 },
        },
      })),
    );
    return () => marks.clear();
  }, [editor, lines, language]);
}
