/** The coding rules of an application in the project settings. */
import { ofKind } from '@/api/objects';
import type { ProjectObject } from '@/api/types';
import { NO_RULES, prefixesFit } from '@/workbench/staticAnalysis/model';

/** Whether the server takes the prefixes of the rules. */
export function hasUsablePrefixes(object: ProjectObject): boolean {
  return !ofKind('application')(object) || prefixesFit(object.data.static_analysis ?? NO_RULES);
}
