import { Library as LibraryIcon, Search, X } from 'lucide-react';
import { useState } from 'react';
import { useText } from '@/i18n';
import { showPanel } from '../docking/dock';
import treeStyles from '../tree/Tree.module.css';
import { IconButton } from '../ui/Button';
import { Empty, Failed, Loading } from '../ui/Empty';
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
    <div className={treeStyles.view}>
      <div className={treeStyles.filter}>
        <Search size={13} aria-hidden />
        <input
          value={search}
          placeholder={t('libraries.search')}
          aria-label={t('libraries.search')}
          spellCheck={false}
          onChange={(event) => setSearch(event.target.value)}
          onKeyDown={(event) => event.key === 'Escape' && setSearch('')}
        />
        {search && <IconButton small icon={X} label={t('tree.clearFilter')} onClick={() => setSearch('')} />}
      </div>
      <LibraryTree
        label={t('panel.libraries')}
        libraries={data}
        search={search}
        onChoose={(library, item) => chooseItem(`${library.name}, ${library.version}`, item)}
        onOpen={() => showPanel('libraryDoc', false)}
      />
    </div>
  );
}
