/** Who is signed in. */
import { create } from 'zustand';
import type { User } from '@/api/types';

interface SessionState {
  user: User | null;
}

export const useSession = create<SessionState>(() => ({ user: null }));

export function setUser(user: User | null): void {
  useSession.setState({ user });
}
