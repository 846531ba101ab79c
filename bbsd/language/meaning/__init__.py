"""What a spec means: constants, the episode as one graph, tables, the structure, the rates."""

from bbsd.language.meaning.elaborating import elaborate
from bbsd.language.meaning.meaning import Meaning, seed_key

__all__ = ["Meaning", "elaborate", "seed_key"]
