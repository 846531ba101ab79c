"""The names of `bbsd` and `bbsd.api`, which are imported when they are first used."""

import ast
from importlib import import_module
from pathlib import Path

import pytest

import bbsd
import bbsd.api

PACKAGES = [bbsd, bbsd.api]


def names_for_type_checkers(module):
    """Return the names that a module imports where types are checked, and those that it imports there or defines."""
    tree = ast.parse(Path(module.__file__).read_text(encoding="utf-8"))
    blocks = [node for node in tree.body if isinstance(node, ast.If)]
    imports = [each for block in blocks for each in block.body if isinstance(each, ast.ImportFrom)]
    return {name.name for each in imports for name in each.names}


@pytest.mark.parametrize("module", PACKAGES, ids=lambda module: module.__name__)
def test_type_checkers_know_the_names_that_are_there(module):
    assert names_for_type_checkers(module) == set(module.__all__) - {"__version__"}


@pytest.mark.parametrize("module", PACKAGES, ids=lambda module: module.__name__)
def test_every_name_is_found_and_completed(module):
    for name in module.__all__:
        assert getattr(module, name) is not None
    assert set(module.__all__) <= set(dir(module))


@pytest.mark.parametrize("module", PACKAGES, ids=lambda module: module.__name__)
def test_a_name_that_is_not_there_is_an_error(module):
    with pytest.raises(AttributeError, match="desing"):
        module.desing  # noqa: B018


def test_both_packages_mean_the_same():
    for name in set(bbsd.__all__) & set(bbsd.api.__all__):
        assert getattr(bbsd, name) is getattr(bbsd.api, name)


def test_names_of_the_api_are_from_where_they_are_said_to_be():
    for home, names in bbsd.api.HOMES.items():
        assert all(hasattr(import_module(home), name) for name in names)
