/** What can be done with a recipe definition: commands, and entries of the menu in its tool bar. */
export const RECIPE_ACTS = [
  { id: 'recipes.addVariables', needs: ['editing'] },
  { id: 'recipes.removeVariables', needs: ['editing', 'rows'] },
  { id: 'recipes.addRecipe', needs: ['editing'] },
  { id: 'recipes.renameRecipe', needs: ['editing', 'recipe'] },
  { id: 'recipes.removeRecipe', needs: ['editing', 'recipe'] },
  { id: 'recipes.read', needs: ['application', 'editing', 'recipe'] },
  { id: 'recipes.write', needs: ['application', 'operating', 'recipe'] },
  { id: 'recipes.import', needs: ['editing'] },
  { id: 'recipes.export', needs: ['recipe'] },
  { id: 'recipes.files', needs: ['application', 'editing'] },
] as const satisfies readonly { id: string; needs: readonly RecipeNeed[] }[];

export type RecipeNeed = 'application' | 'editing' | 'operating' | 'recipe' | 'rows';
export type RecipeActId = (typeof RECIPE_ACTS)[number]['id'];
