"""Projection: meanings onto the flat query fields by which annotated texts are scored."""

from xavi_dialogue.nlu.projection.fields import QueryFields
from xavi_dialogue.nlu.projection.follow_ups import project
from xavi_dialogue.nlu.projection.readings import project_readings

__all__ = ["QueryFields", "project", "project_readings"]
