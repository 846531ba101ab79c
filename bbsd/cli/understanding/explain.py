"""`bbsd explain`."""

from enum import StrEnum
from typing import Annotated

import typer

import bbsd
from bbsd.cli.options import AllowImport, AsJson, DesignFile, ImportFrom, InPython, Overrides, Seed, StepLimit
from bbsd.cli.terminal.access import stepping
from bbsd.cli.terminal.output import say, show
from bbsd.errors import escape
from bbsd.report.plain import json_text
from bbsd.runs.storage.finished import VISITS


class ExplanationFormat(StrEnum):
    """How an explanation is printed."""

    TEXT = "text"
    TABLE = "table"
    TREE = "tree"
    MERMAID = "mermaid"
    DOT = "dot"
    JSON = "json"


def explain(
    spec: DesignFile,
    seed: Seed = 0,
    overrides: Overrides = None,
    episodes: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            min=1,
            help="Count in N episodes how often each cell is asked.",
            show_default="what the run has kept",
        ),
    ] = None,
    worth: Annotated[
        bool,
        typer.Option(
            "--worth", help="Also measure what the design would earn without what seems useless, in episodes."
        ),
    ] = False,
    allow_import: AllowImport = None,
    import_from: ImportFrom = None,
    step_limit: StepLimit = 30.0,
    in_python: InPython = False,
    form: Annotated[
        ExplanationFormat,
        typer.Option(
            "--format",
            help="Sentences; decision tables, and the whole as one table; decision trees; diagrams; or JSON.",
        ),
    ] = ExplanationFormat.TEXT,
    as_json: AsJson = False,
) -> None:
    """Describe what a design does by the shortest rules.

    Layer by layer, and what it could do without. Of a run, it says how often each behavior controlled; of another file
    with --episodes.
    """
    from bbsd.explanation import dot_text, explanation_text, mermaid_text, table_text, tree_text

    explanation = bbsd.explain(
        spec,
        seed=seed,
        episodes=episodes or 0,
        worth=worth,
        set=overrides or (),
        **stepping(allow_import, import_from, step_limit, in_python=in_python),
    )
    if explanation.watched is None and (spec / VISITS).is_file():
        say(f"the visits that {escape(str(spec))} has kept are of another design; --episodes N counts anew")
    if as_json or form is ExplanationFormat.JSON:
        show(json_text(explanation.to_plain()))
        return
    texts = {
        ExplanationFormat.TEXT: explanation_text,
        ExplanationFormat.TABLE: table_text,
        ExplanationFormat.TREE: tree_text,
        ExplanationFormat.MERMAID: mermaid_text,
        ExplanationFormat.DOT: dot_text,
    }
    show(texts[form](explanation))
