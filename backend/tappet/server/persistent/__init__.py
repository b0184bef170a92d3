"""The list of persistent variables: paths of those that programs and function blocks declare."""
