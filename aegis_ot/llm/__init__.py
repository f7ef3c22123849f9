"""Language and vision models behind one small protocol. Workstation side.

Door: :func:`make_backend` for a model by name, :func:`judge_in` for Layer 1 with it,
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
from .configurations import AskingConfiguration, Judgement, judge_in, request_in
from .opinions import Opinions
from .prices import Price, PriceTable, load_prices
from .tokens import RequestSize, estimate_tokens, request_size

__all__ = [
    "MODEL_FORMS",
    "MODEL_VARIABLE",
    "AnthropicBackend",
    "AskingConfiguration",
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
    "RequestSize",
    "RetryPolicy",
    "ScriptedBackend",
    "State",
    "TokenUsage",
    "estimate_tokens",
    "judge_in",
    "load_prices",
    "make_backend",
    "model_from_environment",
    "project_model",
    "record_from_environment",
    "request_in",
    "request_size",
]
