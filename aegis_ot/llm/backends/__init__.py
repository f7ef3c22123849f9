"""Where answers come from: services, recordings, scripts. Door: :func:`make_backend`."""

from ...vocabulary.opinions import MODEL_FORMS
from .anthropic_api import AnthropicBackend
from .exporting import ExportBackend
from .naming import (
    MODEL_VARIABLE,
    make_backend,
    model_from_environment,
    project_model,
    record_from_environment,
)
from .openai_api import OpenAIBackend
from .recording import RecordingBackend, ReplayBackend
from .retrying import Clock, RetryPolicy
from .scripted import ScriptedBackend
from .service import RequestOptions

__all__ = [
    "MODEL_FORMS",
    "MODEL_VARIABLE",
    "AnthropicBackend",
    "Clock",
    "ExportBackend",
    "OpenAIBackend",
    "RecordingBackend",
    "ReplayBackend",
    "RequestOptions",
    "RetryPolicy",
    "ScriptedBackend",
    "make_backend",
    "model_from_environment",
    "project_model",
    "record_from_environment",
]
