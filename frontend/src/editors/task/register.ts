import { lazy } from 'react';
import { registerEditor } from '@/workbench/editors';

registerEditor({ id: 'task', kinds: ['task'], component: lazy(() => import('./TaskEditor')) });
registerEditor({
  id: 'taskConfiguration',
  kinds: ['task_configuration'],
  component: lazy(() => import('./TaskConfigurationEditor')),
});
