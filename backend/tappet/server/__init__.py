"""The IDE server: REST under `/api/v1`, WebSockets, accounts, builds and the online channel.

May import every other room; nothing but the command line imports it. Start reading at `app.create_app`,
then `dependencies` (who may do what), and one folder a resource: `routes`, `shapes` (its JSON; the TypeScript
client is generated from them) and the service behind them.
"""
