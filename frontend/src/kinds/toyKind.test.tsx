// @vitest-environment happy-dom
import type { ReactElement } from 'react';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary, PlacementRule } from '@/api/types';
import { registerKind, type ObjectKindDescriptor } from '@/project/kinds';
import { useProject } from '@/project/openProject';
import { forestOf, rowsOf, rootsOf } from '@/project/tree';
import { PropertiesDialog } from '@/workbench/properties/PropertiesDialog';
import { TreeRow } from '@/workbench/tree/Row';
import { addObject, clear, reads, show, tab } from '../../tests/page';
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
  kind: 'conveyor', places: ['pous_view.*'], once: false,
  naming: 'identifier', names: [], proposal: 'Conveyor', first: '', unique: 'scope', subkinds: ['belt'], languages: [],
}; // prettier-ignore

let unregister: () => void;

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

beforeEach(() => {
  registerKinds(FIXTURES);
  unregister = registerKind(Object.values(FIXTURES)[0]!);
  useProject.setState({ projectId: 'p' });
  queryClient.setQueryData(keys.languages, []);
  queryClient.setQueryData(keys.objects('p'), [belt, robot]);
  queryClient.setQueryData(keys.object('p', 'Belt'), { ...belt, data: { speed: 12 } });
  queryClient.setQueryData(keys.object('p', 'Robot'), { ...robot, data: { axes: ['A1', 'A2'] } });
});

afterEach(() => {
  clear();
  unregister();
});

describe('a kind whose folder is found by its place', () => {
  it('has its icon and short name in the tree', async () => {
    const page = await reads(show(row(belt)), '(BELT)');
    expect(page.querySelector('[data-testid=conveyor-icon]')).not.toBeNull();
  });

  it('is offered by Add Object with its options', async () => {
    const page = show(addObject([rule]));
    await reads(page, 'Return type');
    expect(page.querySelector('[role=radio]')?.textContent).toBe('conveyor');
  });

  it('opens in its editor', async () => {
    await reads(show(tab(belt)), 'Speed 12');
  });

  it('shows its own properties below those of all objects', async () => {
    const page = show(<PropertiesDialog projectId="p" object={belt} close={() => undefined} />);
    await reads(page, 'conveyor · belt');
    await reads(page, 'Belt of Belt');
  });
});

describe('a kind without a folder', () => {
  it('has a neutral icon in the tree', async () => {
    const page = await reads(show(row(robot)), 'Robot');
    expect(page.querySelector('svg')).not.toBeNull();
  });

  it('opens as data to read', async () => {
    const page = await reads(show(tab(robot)), '"A1"');
    expect(page.querySelector('pre')?.textContent).toContain('"A1"');
    expect(page.querySelector('textarea, input')).toBeNull();
  });

  it('shows the properties of all objects', async () => {
    await reads(show(<PropertiesDialog projectId="p" object={robot} close={() => undefined} />), 'robot');
  });
});
