import { lazy } from 'react';
import { registerEditor } from '@/workbench/editors';

registerEditor({
  id: 'libraryManager',
  kinds: ['library_manager'],
  component: lazy(() => import('./LibraryManagerEditor')),
});
