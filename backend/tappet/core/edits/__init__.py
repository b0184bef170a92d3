"""Lowering after an edit: `dependencies` finds the bodies that an edit invalidates, `relower` lowers them."""
