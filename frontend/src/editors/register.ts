/** Registers the text editors of this room; their components are loaded when the first object opens. */
import { Waypoints } from 'lucide-react';
import { lazy } from 'react';
import { registerEditor } from '@/workbench/editors';
import { registerPanel } from '@/workbench/panels';
import { registerIlCommands } from './il/commands';
import { registerTextCommands } from './st/commands';

registerEditor({
  id: 'st',
  kinds: ['pou', 'method', 'action', 'property', 'accessor', 'interface', 'dut', 'gvl', 'persistent'],
  component: lazy(() => import('./st/StEditor')),
});

registerPanel({
  id: 'crossReferences',
  title: 'panel.crossReferences',
  icon: Waypoints,
  component: lazy(() => import('./crossReferences/CrossReferencePanel')),
  position: 'bottom',
  order: 55,
});

registerTextCommands();
registerIlCommands();
