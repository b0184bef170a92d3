"""Search and replace in a project over REST."""
