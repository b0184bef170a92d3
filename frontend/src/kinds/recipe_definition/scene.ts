/** The definition that acts are about, and what is chosen in it. */
import type { OnlineSession } from '@/workbench/onlineSession';
import type { RecipeDefinition } from './model';

export interface RecipeScene {
  projectId: string;
  objectId: string;
  name: string;
  definition: RecipeDefinition;
  change: (definition: RecipeDefinition) => void;
  /** The recipe that acts are about. */
  recipe: string | null;
  choose: (recipe: string | null) => void;
  /** Chosen rows. */
  rows: ReadonlySet<number>;
  session: OnlineSession | null;
}
