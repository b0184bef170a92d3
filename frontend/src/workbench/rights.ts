/** Who may do what, as enablement of commands; the server checks again. */
import type { Role } from '@/api/types';
import type { Enablement } from './commands';
import type { CommandContext } from './context';

const RANK: Record<Role, number> = { viewer: 0, operator: 1, engineer: 2, admin: 3 };

export function atLeast(role: Role | null, wanted: Role): boolean {
  return role !== null && RANK[role] >= RANK[wanted];
}

/** Changing a text: an engineer; while logged in, the text asks first. */
export function mayChangeText(context: CommandContext): Enablement {
  if (!context.projectId) return 'reason.noProject';
  return atLeast(context.role, 'engineer') ? true : 'reason.engineer';
}

/** Changing the project: an engineer, and not while logged in to the controller. */
export function mayEdit(context: CommandContext): Enablement {
  const allowed = mayChangeText(context);
  return allowed === true && context.online ? 'reason.logOutToEdit' : allowed;
}
