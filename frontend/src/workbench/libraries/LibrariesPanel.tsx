import { Library as LibraryIcon } from 'lucide-react';
import { useState } from 'react';
import { useText } from '@/i18n';
import { showPanel } from '../docking/dock';
import { TreeFilter } from '../tree/TreeFilter';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Panel } from '@/ui/Panel';
import { chooseItem } from './chosen';
import { LibraryTree } from './LibraryTree';
import { useLibraries } from './useLibraries';

/** All installed libraries with their contents; Enter or a double click shows the documentation. */
export default function LibrariesPanel() {
  const t = useText();
  const { data, error, refetch } = useLibraries();
  const [search, setSearch] = useState('');
  if (error) return <Failed error={error} retry={() => void refetch()} />;
  if (!data) return <Loading />;
  if (data.length === 0) return <Empty icon={LibraryIcon} title={t('libraries.none')} />;
  return (
    <Panel>
      <TreeFilter label={t('libraries.search')} value={search} onValue={setSearch} />
      <LibraryTree
        label={t('panel.libraries')}
        libraries={data}
        search={search}
        onChoose={(library, item) => chooseItem(`${library.name}, ${library.version}`, item)}
        onOpen={() => showPanel('libraryDoc', false)}
      />
    </Panel>
  );
}
