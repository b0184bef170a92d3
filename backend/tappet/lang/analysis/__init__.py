"""Declarations, types, names, constants and calls: from syntax trees to a checked, resolved program.

Imports only `lang`. Start reading at `result` (what analysis leaves for code generation) and `run`
(the order of the passes); `expressions`, `calls`, `statements` handle one node class per function.
"""

from tappet.lang.analysis.result import Analysis, AnalysisOptions, ConfiguredAddress, carried_type
from tappet.lang.analysis.run import analyse, prepare, resume
from tappet.lang.analysis.tasks import check_tasks

__all__ = [
    "Analysis",
    "AnalysisOptions",
    "ConfiguredAddress",
    "analyse",
    "carried_type",
    "check_tasks",
    "prepare",
    "resume",
]
