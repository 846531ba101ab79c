"""What `bbsd design` prints: the result of a design, of several seeds, or a price."""

from typing import TYPE_CHECKING

from bbsd.cli.terminal.output import say, show, show_table
from bbsd.report.plain import design_plain, disagreement_plain, json_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.api import Designed
    from bbsd.cli.terminal.access import Stepping
    from bbsd.language.loading import Loaded


def show_design(designed: "Designed", seed: int, runs: int, *, by_time: bool, as_json: bool) -> None:
    """Print the result of a design."""
    if by_time or any(each.ended_by == "time" for each in designed.ended):
        say("what a time ends cannot be reproduced: the same command may give another design")
    if as_json:
        show(json_text(design_plain(designed, seed, runs)))
        return
    from bbsd.report.tables import design_table

    show_table(design_table(designed))


def show_seeds(several: "Mapping[int, Designed]", *, as_json: bool) -> None:
    """Print the results of designs by their seeds."""
    if as_json:
        designs = [design_plain(designed, seed, 1) for seed, designed in several.items()]
        show(json_text({"designs": designs, **disagreement_plain(several.values())}))
        return
    from bbsd.report.tables import seeds_table

    show_table(seeds_table(several))


def show_price(
    loaded: "Loaded",
    opening: "Stepping",
    seed: int,
    *,
    runs: int,
    lanes: int,
    jobs: int,
    starting: float,
    as_json: bool,
) -> None:
    """Print what a design costs."""
    from bbsd import api
    from bbsd.report.spec.price import price_plain, price_text

    price = api.price(loaded, seed=seed, runs=runs, lanes=lanes, jobs=jobs, starting=starting, **opening)
    show(json_text(price_plain(price)) if as_json else price_text(price))
