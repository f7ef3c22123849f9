"""Language and vision models behind one small protocol. Workstation side.

Door: :func:`make_backend` for a model by name, :func:`hybrid` for Layer 1 with it,
:class:`Opinions` for the sidecar. The gate of Layer 2 is in :mod:`.vlm`, which alone needs OpenCV.
"""

from ..vocabulary.opinions import MODEL_FORMS
from .backend import Backend, Message, Passage, PromptPicture, Reply, Request, State, TokenUsage
from .backends.anthropic_api import AnthropicBackend
from .backends.exporting import ExportBackend
from .backends.naming import (
    MODEL_VARIABLE,
    make_backend,
    model_from_environment,
    project_model,
    record_from_environment,
)
from .backends.openai_api import OpenAIBackend
from .backends.recording import RecordingBackend, ReplayBackend
from .backends.retrying import RetryPolicy
from .backends.scripted import ScriptedBackend
from .backends.service import RequestOptions
from .hybrid import Judgement, hybrid
from .opinions import Opinions
from .prices import Price, PriceTable, load_prices

__all__ = [
    "MODEL_FORMS",
    "MODEL_VARIABLE",
    "AnthropicBackend",
    "Backend",
    "ExportBackend",
    "Judgement",
    "Message",
    "OpenAIBackend",
    "Opinions",
    "Passage",
    "Price",
    "PriceTable",
    "PromptPicture",
    "RecordingBackend",
    "ReplayBackend",
    "Reply",
    "Request",
    "RequestOptions",
    "RetryPolicy",
    "ScriptedBackend",
    "State",
    "TokenUsage",
    "hybrid",
    "load_prices",
    "make_backend",
    "model_from_environment",
    "project_model",
    "record_from_environment",
]
