"""The source of a project in the controller: stored with a download or on demand, read back as a project."""
