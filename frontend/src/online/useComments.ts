import { holdsValues } from '@/project/kinds';
import { useQueries } from '@tanstack/react-query';
import { useMemo } from 'react';
import { dataText } from '@/api/objects';
import { objectQuery, useObjects } from '@/api/queries';
import { joinComments } from '@/iec/declaration/comments';
import { parseDeclaration } from '@/iec/declaration/parse';

/** Comment of the declaration of a variable, for paths of two parts such as `PLC_PRG.iCount` or `GVL.x`. */
export function useComments(projectId: string | null): (expression: string) => string | undefined {
  const { data: objects } = useObjects(projectId);
  const owners = useMemo(() => (objects ?? []).filter(holdsValues), [objects]);
  const texts = useQueries({
    queries: owners.map((o) => objectQuery(projectId ?? '', o.id)),
    combine: (answers) => answers.flatMap((answer) => answer.data ?? []),
  });
  return useMemo(() => {
    const comments = new Map<string, string>();
    for (const text of texts) {
      for (const row of parseDeclaration(dataText(text, 'declaration')).rows) {
        const comment = joinComments(row.comments.map((cell) => cell.text));
        if (comment !== '') comments.set(`${text.name}.${row.name.text}`.toUpperCase(), comment);
      }
    }
    return (expression: string) => comments.get(expression.toUpperCase());
  }, [texts]);
}
