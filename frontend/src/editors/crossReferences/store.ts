/** What the cross-reference panel shows: the last question and its answer. */
import { create } from 'zustand';
import { crossReferences, type CrossReference, type Question } from '@/lsp/symbols';

interface CrossReferences {
  /** Null before the first question. */
  question: Question | null;
  projectId: string | null;
  /** What was asked for, as the user reads it. */
  name: string;
  busy: boolean;
  places: readonly CrossReference[];
}

export const useCrossReferences = create<CrossReferences>(() => ({
  question: null,
  projectId: null,
  name: '',
  busy: false,
  places: [],
}));

/** Asks the language server; the newest question wins. Throws with the server's reason when it refuses. */
export async function findCrossReferences(projectId: string, question: Question, name: string): Promise<void> {
  useCrossReferences.setState({ question, projectId, name, busy: true });
  let places: readonly CrossReference[] = [];
  try {
    places = await crossReferences(projectId, question);
  } finally {
    if (useCrossReferences.getState().question === question) useCrossReferences.setState({ places, busy: false });
  }
}

/** The same question again, of the texts as they are now. A place may have moved: its name is asked for then. */
export async function refreshCrossReferences(): Promise<void> {
  const { projectId, name, places } = useCrossReferences.getState();
  if (projectId === null) return;
  const symbols = new Set(places.map((place) => place.symbol));
  const asked = symbols.size === 1 ? ([...symbols][0] ?? name) : name;
  await findCrossReferences(projectId, { name: asked }, asked);
}
