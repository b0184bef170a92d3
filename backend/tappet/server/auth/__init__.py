"""Accounts, sessions, tokens and the rules who may do what.

Start reading at `identity` (what a request proves), then `accounts` (users and login) and `roles`.
"""
