/** Components in a page, as the workbench shows them. */
import { QueryClientProvider } from '@tanstack/react-query';
import type { IDockviewPanelProps } from 'dockview-react';
import type { ReactElement } from 'react';
import { createRoot, type Root } from 'react-dom/client';
import { queryClient } from '@/api/queries';
import type { ObjectSummary, PlacementRule } from '@/api/types';
import { forestOf } from '@/project/tree';
import { TooltipProvider } from '@/ui/Tooltip';
import { AddObjectDialog } from '@/workbench/addObject/AddObjectDialog';
import { EditorPanel } from '@/workbench/docking/EditorPanel';

let root: Root | undefined;

/** Shows an element in place of what was shown. */
export function show(element: ReactElement): HTMLElement {
  clear();
  root = createRoot(document.body.appendChild(document.createElement('div')));
  root.render(
    <QueryClientProvider client={queryClient}>
      <TooltipProvider>{element}</TooltipProvider>
    </QueryClientProvider>,
  );
  return document.body;
}

export function clear(): void {
  root?.unmount();
  root = undefined;
  document.body.replaceChildren();
}

/** The page as soon as something holds of it: looked at again whenever it changes, so no time is waited for. */
export function until(page: HTMLElement, holds: (page: HTMLElement) => boolean): Promise<HTMLElement> {
  return new Promise((resolve) => {
    const look = () => {
      if (!holds(page)) return;
      observer.disconnect();
      resolve(page);
    };
    const observer = new MutationObserver(look);
    observer.observe(page, { subtree: true, childList: true, characterData: true, attributes: true });
    look();
  });
}

/** The page as soon as it shows a text. */
export function reads(page: HTMLElement, text: string): Promise<HTMLElement> {
  return until(page, ({ textContent }) => textContent.includes(text));
}

/** The tab of an object. */
export function tab(object: ObjectSummary): ReactElement {
  const api = {
    id: 'tab',
    title: object.name,
    isVisible: true,
    setTitle: () => undefined,
    onDidVisibilityChange: () => ({ dispose: () => undefined }),
  };
  const props = { api, params: { objectId: object.id, instance: null, reveal: null } };
  return <EditorPanel {...(props as unknown as IDockviewPanelProps<never>)} />;
}

/** Add Object at the root of the POUs view of an empty project. */
export function addObject(rules: readonly PlacementRule[]): ReactElement {
  const nothing = () => undefined;
  return (
    <AddObjectDialog projectId="p" forest={forestOf([])} rules={rules} view="pous" parentId={null} close={nothing} />
  );
}
