"""Projects: the list, archives, revisions."""
