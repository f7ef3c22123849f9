"""Language and vision models behind one small protocol. Workstation side.

Door: :func:`make_backend` for a model by name, :func:`judge_in` for Layer 1 with it,
:class:`Opinions` for the sidecar. The gate of Layer 2 is in :mod:`.vlm`, which alone needs OpenCV.
"""

from .backend import Backend, Message, Passage, Picture, Reply, Request, State, Usage
from .backends import (
    MODEL_FORMS,
    MODEL_VARIABLE,
    AnthropicBackend,
    ExportBackend,
    Manner,
    OpenAIBackend,
    Patience,
    RecordingBackend,
    ReplayBackend,
    ScriptedBackend,
    make_backend,
    model_from_environment,
    project_model,
    record_from_environment,
)
from .configurations import Configuration, Judgement, judge_in, request_in
from .opinions import Opinions
from .prices import Price, PriceTable, load_prices
from .tokens import RequestSize, estimate_tokens, request_size

__all__ = [
    "MODEL_FORMS",
    "MODEL_VARIABLE",
    "AnthropicBackend",
    "Backend",
    "Configuration",
    "ExportBackend",
    "Judgement",
    "Manner",
    "Message",
    "OpenAIBackend",
    "Opinions",
    "Passage",
    "Patience",
    "Picture",
    "Price",
    "PriceTable",
    "RecordingBackend",
    "ReplayBackend",
    "Reply",
    "Request",
    "RequestSize",
    "ScriptedBackend",
    "State",
    "Usage",
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
