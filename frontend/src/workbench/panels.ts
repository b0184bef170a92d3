/**
 * The panel registry: tool windows of the docks (trees, messages, watch lists ...).
 *
 * Register in the function of your room's `register.ts`, which `app/rooms.ts` calls:
 *
 *     registerPanel({
 *       id: 'watch1',
 *       title: 'panel.watch', titleValues: { number: 1 },
 *       icon: Eye,
 *       component: onDemand(() => import('./watch/WatchPanel')),
 *       props: { list: 1 },                       // reaches the component as `props.options`
 *       position: 'bottom', order: 20,
 *       initial: true,                            // part of the default layout; otherwise opened from the View menu
 *     });
 *
 * The View menu gets an entry `view.<id>` for each panel by itself. `showPanel(id)` (workbench/docking/dock.ts) opens or raises one.
 */
import { useSyncExternalStore, type ComponentType } from 'react';
import type { TextKey, TextValues } from '@/i18n';
import type { IconComponent } from '@/icons/IconComponent';
import type { MenuEntry } from '@/ui/Menu';

export type DockPosition = 'left' | 'right' | 'bottom';

export interface PanelProps {
  /** Id of the dock panel; same as the registration's id. */
  panelId: string;
  /** `props` of the registration. */
  options: Readonly<Record<string, unknown>>;
  visible: boolean;
}

export interface PanelRegistration {
  id: string;
  title: TextKey;
  titleValues?: TextValues;
  icon: IconComponent;
  component: ComponentType<PanelProps>;
  props?: Readonly<Record<string, unknown>>;
  position: DockPosition;
  /** Order of the tabs in the default layout and of the entries in the View menu. */
  order: number;
  initial?: boolean;
  /** Submenu of the View menu, for families such as Watch 1 to 4. */
  submenu?: TextKey;
  keys?: readonly string[];
  /** A live count on the tab (messages, forces); null shows none. A hook, called inside the tab. */
  useBadge?: () => { text: string; tone: 'neutral' | 'warn' | 'error' | 'forced' } | null;
  /** What else the context menu of its tab offers. */
  entries?: () => readonly MenuEntry[];
}

const registrations = new Map<string, PanelRegistration>();
const followers = new Set<() => void>();
const loaders = new Set<(projectId: string) => Promise<void>>();

/** Registers a panel, or another title and content for one that is there. Returns what takes it away again. */
export function registerPanel(registration: PanelRegistration): () => void {
  registrations.set(registration.id, registration);
  followers.forEach((follower) => follower());
  return () => {
    if (registrations.get(registration.id) !== registration) return;
    registrations.delete(registration.id);
    followers.forEach((follower) => follower());
  };
}

export function findPanel(id: string): PanelRegistration | undefined {
  return registrations.get(id);
}

/** As `findPanel`, for components: drawn again when the panel changes. */
export function usePanel(id: string): PanelRegistration | undefined {
  return useSyncExternalStore(followPanels, () => registrations.get(id));
}

/** Calls the follower whenever panels have come, changed or gone. */
export function followPanels(follower: () => void): () => void {
  followers.add(follower);
  return () => followers.delete(follower);
}

/** Panels that belong to a project (watch lists of the user) are registered before its layout is restored. */
export function registerPanelLoader(load: (projectId: string) => Promise<void>): void {
  loaders.add(load);
}

export async function loadPanels(projectId: string): Promise<void> {
  await Promise.all([...loaders].map((load) => load(projectId)));
}

/** All panels in the order of the View menu. */
export function allPanels(): PanelRegistration[] {
  return [...registrations.values()].sort((a, b) => a.order - b.order);
}
