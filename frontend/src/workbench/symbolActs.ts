/** What can be done with the declaration of a watched variable: the editors register it here. */
import { guard } from '@/ui/notices';

export interface SymbolActs {
  /** Opens what the last name of an expression means. */
  goToDefinition: (expression: string) => Promise<void>;
  /** Every place of it, in the panel. */
  showCrossReferences: (expression: string) => Promise<void>;
}

let acts: SymbolActs | null = null;

export function setSymbolActs(registered: SymbolActs): void {
  acts = registered;
}

export function actOnSymbol(act: keyof SymbolActs, expression: string): void {
  void guard(async () => acts?.[act](expression));
}
