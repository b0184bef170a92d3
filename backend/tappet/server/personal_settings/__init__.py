"""What each user has set for oneself."""
