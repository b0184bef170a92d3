import { lazy } from 'react';
import { registerEditor } from '@/workbench/editors';

registerEditor({ id: 'device', kinds: ['device'], component: lazy(() => import('./DeviceEditor')) });
registerEditor({ id: 'application', kinds: ['application'], component: lazy(() => import('./ApplicationEditor')) });
