"""Grounding: what readings speak of, found in the scene, the record and the discourse."""

from xavi_dialogue.nlu.grounding.ground import ground
from xavi_dialogue.nlu.grounding.result import Grounding

__all__ = ["Grounding", "ground"]
