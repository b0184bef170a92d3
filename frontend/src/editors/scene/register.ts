import { lazy } from 'react';
import { registerEditor } from '@/workbench/editors';

registerEditor({ id: 'scene', kinds: ['scene'], component: lazy(() => import('./SceneEditor')) });
