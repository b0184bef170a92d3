/** Registers the text editors of this room; their components are loaded when the first object opens. */
import { lazy } from 'react';
import { registerEditor } from '@/workbench/editors';
import { registerTextCommands } from './st/commands';

registerEditor({
  id: 'st',
  kinds: ['pou', 'method', 'action', 'property', 'accessor', 'interface', 'dut', 'gvl', 'persistent'],
  component: lazy(() => import('./st/StEditor')),
});

registerTextCommands();
