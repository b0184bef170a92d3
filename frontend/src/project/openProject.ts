/** Which project is open and which of its applications the commands act on. */
import { create } from 'zustand';

interface OpenProject {
  projectId: string | null;
  projectName: string;
  /** The active application: target of build, login and of the watch lists. */
  applicationId: string | null;
  /** Task under way that the status bar names: build, login, download. */
  busy: { text: string; cancel?: () => void } | null;
}

export const useProject = create<OpenProject>(() => ({
  projectId: null,
  projectName: '',
  applicationId: null,
  busy: null,
}));

export function setActiveApplication(applicationId: string | null): void {
  useProject.setState({ applicationId });
}
