/** Which page is shown: `#/` the start page, `#/project/<id>` the workbench. The hash needs no help from the server. */
import { create } from 'zustand';

export type Route = { page: 'start' } | { page: 'project'; projectId: string };

export function parseRoute(hash: string): Route {
  const match = /^#\/project\/([\w-]+)$/.exec(hash);
  return match ? { page: 'project', projectId: match[1]! } : { page: 'start' };
}

export function routeHash(route: Route): string {
  return route.page === 'project' ? `#/project/${route.projectId}` : '#/';
}

export const useRoute = create<Route>(() => ({ page: 'start' }));

export function go(route: Route): void {
  location.hash = routeHash(route);
}

export function listenToRoute(): () => void {
  const read = () => useRoute.setState(parseRoute(location.hash), true);
  read();
  window.addEventListener('hashchange', read);
  return () => window.removeEventListener('hashchange', read);
}
