import { useQuery } from '@tanstack/react-query';
import { FolderTree, Plus, SearchX } from 'lucide-react';
import { useMemo, useState } from 'react';
import { api } from '@/api/client';
import { keys, useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { useCommandContext } from '../useCommandContext';
import type { PanelProps } from '../panels';
import { useProject } from '@/project/openProject';
import { mayEdit } from '../rights';
import { reasonText, runCommand } from '../run';
import { firstKind, kindWithRole } from '@/project/kinds';
import { Button } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Panel } from '@/ui/Panel';
import { forestOf, rootsOf, rowsOf, type TreeView } from '@/project/tree';
import { ObjectTree } from './ObjectTree';
import { TreeFilter } from './TreeFilter';

/** The placement rules; they do not change while the server runs. */
export function usePlacement() {
  return useQuery({
    queryKey: keys.placement,
    queryFn: () => api.get('/api/v1/placement'),
    staleTime: Infinity,
  });
}

/** The Devices view or, with `options.view === 'pous'`, the POUs view. */
export default function TreePanel({ panelId, options }: PanelProps) {
  const t = useText();
  const view = options.view as TreeView;
  const projectId = useProject((state) => state.projectId);
  const objects = useObjects(projectId);
  const placement = usePlacement();
  const [filter, setFilter] = useState('');
  const forest = useMemo(() => forestOf(objects.data ?? []), [objects.data]);
  const roots = useMemo(() => rootsOf(forest, view), [forest, view]);

  const failed = objects.isError ? objects : placement.isError ? placement : null;
  if (failed) return <Failed error={failed.error} retry={() => void failed.refetch()} />;
  if (!projectId || !objects.data || !placement.data) return <Loading />;
  const nothingFound = filter.trim() !== '' && rowsOf(forest, roots, new Set(), filter).length === 0;
  return (
    <Panel>
      <TreeFilter label={t('tree.filter')} value={filter} onValue={setFilter} />
      {roots.length === 0 ? (
        <NoObjects view={view} />
      ) : nothingFound ? (
        <Empty icon={SearchX} title={t('tree.nothingFound', { text: filter.trim() })} />
      ) : (
        <ObjectTree
          panelId={panelId}
          projectId={projectId}
          view={view}
          objects={objects.data}
          forest={forest}
          roots={roots}
          rules={placement.data}
          filter={filter}
          label={t(view === 'devices' ? 'panel.devices' : 'panel.pous')}
        />
      )}
    </Panel>
  );
}

function NoObjects({ view }: { view: TreeView }) {
  const t = useText();
  const allowed = mayEdit(useCommandContext());
  const devices = view === 'devices';
  const kind = (devices ? kindWithRole('device') : firstKind())?.kind;
  return (
    <Empty
      icon={FolderTree}
      title={t(devices ? 'tree.noDevices' : 'tree.noPous')}
      text={t(devices ? 'tree.noDevicesText' : 'tree.noPousText')}
    >
      <Button
        icon={Plus}
        disabledReason={allowed === true ? null : reasonText(allowed)}
        onClick={() => void runCommand('project.addObject', { kind, parentId: null, view })}
      >
        {t(devices ? 'tree.addDevice' : 'tree.addPou')}
      </Button>
    </Empty>
  );
}
