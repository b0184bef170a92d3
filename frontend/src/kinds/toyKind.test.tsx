// @vitest-environment happy-dom
import { QueryClientProvider } from '@tanstack/react-query';
import type { IDockviewPanelProps } from 'dockview-react';
import { act, type ReactElement } from 'react';
import { createRoot, type Root } from 'react-dom/client';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary, PlacementRule } from '@/api/types';
import { registerKind, type ObjectKindDescriptor } from '@/project/kinds';
import { useProject } from '@/project/openProject';
import { forestOf, rowsOf, rootsOf } from '@/project/tree';
import { TooltipProvider } from '@/ui/Tooltip';
import { AddObjectDialog } from '@/workbench/addObject/AddObjectDialog';
import { EditorPanel } from '@/workbench/docking/EditorPanel';
import { PropertiesDialog } from '@/workbench/properties/PropertiesDialog';
import { TreeRow } from '@/workbench/tree/Row';
import { registerKinds } from './register';

const FIXTURES = import.meta.glob<ObjectKindDescriptor>('../../tests/fixtures/kinds/*/index.tsx', {
  eager: true,
  import: 'default',
});
const object = (id: string, kind: string, subkind: string | null = null): ObjectSummary => ({
  id, kind, subkind, name: id, parent_id: null, index: 0, revision: 3, excluded: false,
}); // prettier-ignore
const belt = object('Belt', 'conveyor', 'belt');
const robot = object('Robot', 'robot');
const rule: PlacementRule = {
  kind: 'conveyor', parents: ['pous_view'], parent_subkinds: [], in_folders: true, once: false,
  naming: 'identifier', names: [], proposal: 'Conveyor', subkinds: ['belt'], languages: [],
}; // prettier-ignore

let root: Root;
let unregister: () => void;
vi.stubGlobal('IS_REACT_ACT_ENVIRONMENT', true);

async function shown(element: ReactElement): Promise<HTMLElement> {
  await act(async () => {
    root.render(
      <QueryClientProvider client={queryClient}>
        <TooltipProvider>{element}</TooltipProvider>
      </QueryClientProvider>,
    );
    await Promise.resolve();
  });
  return document.body;
}

/** Waits for a text of a component that is loaded when it is first shown. */
async function reads(page: HTMLElement, text: string): Promise<void> {
  await vi.waitFor(
    async () => {
      await act(async () => await new Promise((resolve) => setTimeout(resolve, 20)));
      expect(page.textContent).toContain(text);
    },
    { timeout: 30_000 },
  );
}

function row(shownObject: ObjectSummary): ReactElement {
  const forest = forestOf([shownObject]);
  const [first] = rowsOf(forest, rootsOf(forest, 'pous'), new Set());
  return (
    <TreeRow
      row={first!}
      filter=""
      strong={false}
      tone={undefined}
      relation={undefined}
      mark={undefined}
      excluded={false}
      renaming={false}
      faultOf={() => null}
      onTwist={() => undefined}
      onRenamed={() => undefined}
    />
  );
}

function tab(shownObject: ObjectSummary): ReactElement {
  const api = {
    id: 'tab',
    title: shownObject.name,
    isVisible: true,
    setTitle: () => undefined,
    onDidVisibilityChange: () => ({ dispose: () => undefined }),
  };
  const props = { api, params: { objectId: shownObject.id, instance: null, reveal: null } };
  return <EditorPanel {...(props as unknown as IDockviewPanelProps<never>)} />;
}

beforeEach(() => {
  registerKinds(FIXTURES);
  unregister = registerKind(Object.values(FIXTURES)[0]!);
  root = createRoot(document.body.appendChild(document.createElement('div')));
  useProject.setState({ projectId: 'p' });
  queryClient.setQueryData(keys.languages, []);
  queryClient.setQueryData(keys.objects('p'), [belt, robot]);
  queryClient.setQueryData(keys.object('p', 'Belt'), { ...belt, data: { speed: 12 } });
  queryClient.setQueryData(keys.object('p', 'Robot'), { ...robot, data: { axes: ['A1', 'A2'] } });
});

afterEach(async () => {
  await act(() => Promise.resolve(root.unmount()));
  document.body.replaceChildren();
  unregister();
});

describe('a kind whose folder is found by its place', () => {
  it('has its icon and short name in the tree', async () => {
    const page = await shown(row(belt));
    expect(page.querySelector('[data-testid=conveyor-icon]')).not.toBeNull();
    expect(page.textContent).toContain('(BELT)');
  });

  it('is offered by Add Object with its options', async () => {
    const page = await shown(
      <AddObjectDialog
        projectId="p"
        forest={forestOf([])}
        rules={[rule]}
        view="pous"
        parentId={null}
        close={() => undefined}
      />,
    );
    expect(page.querySelector('[role=radio]')?.textContent).toBe('conveyor');
    expect(page.textContent).toContain('Return type');
  });

  it('opens in its editor', async () => {
    await reads(await shown(tab(belt)), 'Speed 12');
  });

  it('shows its own properties below those of all objects', async () => {
    const page = await shown(<PropertiesDialog projectId="p" object={belt} close={() => undefined} />);
    expect(page.textContent).toContain('conveyor, belt');
    await reads(page, 'Belt of Belt');
  });
});

describe('a kind without a folder', () => {
  it('has a neutral icon in the tree', async () => {
    expect((await shown(row(robot))).querySelector('svg')).not.toBeNull();
  });

  it('opens as data to read', async () => {
    const page = await shown(tab(robot));
    await reads(page, '"A1"');
    expect(page.querySelector('pre')?.textContent).toContain('"A1"');
    expect(page.querySelector('textarea, input')).toBeNull();
  });

  it('shows the properties of all objects', async () => {
    const page = await shown(<PropertiesDialog projectId="p" object={robot} close={() => undefined} />);
    expect(page.textContent).toContain('robot');
  });
});
