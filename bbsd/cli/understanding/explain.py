"""`bbsd explain`."""

import bbsd
from bbsd.cli.options import AsFormat, DesignFile, Overrides, ResultFormat, Seed
from bbsd.cli.output import show
from bbsd.report.plain import json_text


def explain(
    spec: DesignFile, seed: Seed = 0, overrides: Overrides = None, form: AsFormat = ResultFormat.TEXT
) -> None:
    """Describe in words what a design does, layer by layer."""
    from bbsd.explanation import explanation_text

    explanation = bbsd.explain(spec, seed=seed, overrides=overrides or ())
    show(json_text(explanation.to_plain()) if form is ResultFormat.JSON else explanation_text(explanation))
