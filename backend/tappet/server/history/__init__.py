"""Going back: undo and redo of changes of the tree, what was deleted."""
