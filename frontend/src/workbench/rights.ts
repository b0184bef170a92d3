/** Who may do what, as enablement of commands; the server checks again. */
import type { Role } from '@/api/types';
import type { Enablement } from './commands';
import type { CommandContext } from './context';

const RANK: Record<Role, number> = { viewer: 0, operator: 1, engineer: 2, admin: 3 };

export function atLeast(role: Role | null, wanted: Role): boolean {
  return role !== null && RANK[role] >= RANK[wanted];
}

/** Changing the project: an engineer, and not while logged in to the controller. */
export function mayEdit(context: CommandContext): Enablement {
  if (!context.projectId) return 'reason.noProject';
  if (!atLeast(context.role, 'engineer')) return 'reason.engineer';
  return context.online ? 'reason.logOutToEdit' : true;
}
