"""Where answers come from: services, recordings, scripts. Door: :func:`make_backend`."""

from .anthropic_api import AnthropicBackend
from .naming import MODEL_VARIABLE, make_backend, model_from_environment
from .openai_api import OpenAIBackend
from .recording import RecordingBackend, ReplayBackend
from .retrying import Clock, Patience
from .scripted import ScriptedBackend
from .service import Manner

__all__ = [
    "MODEL_VARIABLE",
    "AnthropicBackend",
    "Clock",
    "Manner",
    "OpenAIBackend",
    "Patience",
    "RecordingBackend",
    "ReplayBackend",
    "ScriptedBackend",
    "make_backend",
    "model_from_environment",
]
