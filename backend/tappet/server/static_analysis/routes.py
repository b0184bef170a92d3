"""Static analysis: the coding rules there are, and running those that an application has chosen."""

from __future__ import annotations

from tappet.lang.coding_settings import LIMITS, OF_RULE, PREFIXES
from tappet.lang.diagnostic_translations import texts
from tappet.lang.diagnostics import CODING_RULES, TABLE, WARNINGS
from tappet.server.builds.shapes import BuildReport
from tappet.server.dependencies import CommissioningDep, Engineer, Viewer
from tappet.server.routing import Router
from tappet.server.static_analysis.shapes import CodingRule, CompilerWarning
from tappet.translation.language import Language

router = Router(tags=["build"])


@router.get("/static-analysis/rules")
def list_coding_rules(who: Viewer, language: Language = "en") -> list[CodingRule]:
    """All coding rules, by code, described in a language."""
    return [
        CodingRule(
            code=code,
            name=TABLE[code].name,
            numbers=TABLE[code].aliases,
            message=texts(code, language).message,
            advice=texts(code, language).advice,
            prefixes={key: PREFIXES[key] for key in OF_RULE.get(code, ()) if key in PREFIXES},
            limits={key: LIMITS[key] for key in OF_RULE.get(code, ()) if key in LIMITS},
        )
        for code in sorted(CODING_RULES)
    ]


@router.get("/compiler-warnings")
def list_compiler_warnings(who: Viewer, language: Language = "en") -> list[CompilerWarning]:
    """All warnings and notes of the compiler, by code; `disabled_warnings` of an application names them."""
    return [
        CompilerWarning(
            code=code,
            severity="info" if TABLE[code].severity == "info" else "warning",
            numbers=TABLE[code].aliases,
            message=texts(code, language).message,
            advice=texts(code, language).advice,
        )
        for code in sorted(WARNINGS)
    ]


@router.post("/projects/{project_id}/applications/{application_id}/static-analysis")
async def run_static_analysis(
    project_id: str,
    application_id: str,
    who: Engineer,
    commissioning: CommissioningDep,
    language: Language = "en",
) -> BuildReport:
    """Check the application with the rules it has chosen, also with those that do not run with each build."""
    report = await commissioning.analyse(project_id, application_id)
    return report.in_language(language)
