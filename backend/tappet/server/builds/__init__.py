"""Builds, checks and downloads. Start at `commissioning`; `builder` orders builds of `worker` processes."""
