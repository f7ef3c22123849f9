from __future__ import annotations

import json
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.llm import State, make_backend, model_from_environment
from aegis_ot.llm.backends.anthropic_api import AnthropicBackend
from aegis_ot.llm.backends.openai_api import OpenAIBackend
from aegis_ot.llm.backends.recording import RecordingBackend

from .samples import GOOD, request
from .wire_server import Answer, WireServer, openai_completion


def test_names_of_services() -> None:
    assert isinstance(make_backend("anthropic:claude-x"), AnthropicBackend)
    backend = make_backend("openai:llama3.1:8b@http://127.0.0.1:11434/v1/")
    assert isinstance(backend, OpenAIBackend)
    assert backend.model == "llama3.1:8b"
    assert backend.name == "openai:llama3.1:8b@http://127.0.0.1:11434/v1"
    assert make_backend("openai:vendor/model@2@https://host/v1").name.startswith(
        "openai:vendor/model@2@"
    )


def test_a_name_leads_to_the_server_with_its_options(
    server: WireServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LAB_KEY", "lab-secret")
    server.answers = [
        Answer(body=openai_completion(None, "tool_calls", arguments=json.dumps(GOOD)))
    ]
    name = f"openai:m@{server.url}/v1#structured=tool&limit=max_completion_tokens&key=LAB_KEY"
    reply = make_backend(name, trust_env=False).ask(request())
    assert reply.value == GOOD
    sent = server.seen[0]
    assert sent.headers["authorization"] == "Bearer lab-secret"
    assert sent.body["max_completion_tokens"] == 1200
    assert "tools" in sent.body


def test_more_room_for_models_that_think_first(server: WireServer) -> None:
    server.answers = [Answer(body=openai_completion(json.dumps(GOOD)))]
    make_backend(f"openai:m@{server.url}/v1#output=8000", trust_env=False).ask(request())
    assert server.seen[0].body["max_tokens"] == 8000


def test_the_named_variable_must_hold_a_key(server: WireServer) -> None:
    reply = make_backend(f"openai:m@{server.url}/v1#key=LAB_KEY", trust_env=False).ask(request())
    assert reply.state is State.NO_KEY
    assert "LAB_KEY" in reply.detail


def test_recording_is_asked_for_beside_the_name(tmp_path: Path) -> None:
    assert isinstance(make_backend("openai:m", record=tmp_path / "r"), RecordingBackend)


@pytest.mark.parametrize(
    "name",
    [
        "",
        "claude",
        "gemini:x",
        "anthropic:",
        "openai:@http://host/v1",
        "openai:m@http://user:password@host/v1",
        "openai:m@http://host/v1?api_key=sk-1",
        "openai:m#structure=tool",
        "openai:m#structured=xml",
        "anthropic:m#structured=guided_json",
        "anthropic:m#timeout=soon",
        "anthropic:m#timeout=0",
        "anthropic:m#timeout=nan",
        "anthropic:m#attempts=0.5",
        "anthropic:m#key=sk-ant-123",
        "anthropic:sk-ant-123",
        "sk-ant-123",
        "openai:m#limit=model",
        "openai:m@http://[::1/v1",
        "openai:m@http://host:99999/v1",
        "openai:m@http://host:port/v1",
        "openai:m@http://ho st/v1",
        "openai:m\nx",
        "replay:/no/such/folder/anywhere",
    ],
)
def test_names_that_make_no_sense(name: str) -> None:
    with pytest.raises(ConfigurationError) as told:
        make_backend(name)
    assert "sk-ant-123" not in str(told.value)
    assert "password@" not in str(told.value)


@pytest.mark.parametrize("address", ["localhost:8000/v1", "192.168.1.3:11434/v1", "ftp://host/v1"])
def test_an_address_without_its_scheme_is_not_taken_for_the_models_name(address: str) -> None:
    """The protocol would go to OpenAI, though it was meant for a server of one's own."""
    with pytest.raises(ConfigurationError, match="http://"):
        make_backend(f"openai:m@{address}")


def test_a_folder_may_be_called_what_a_key_is(tmp_path: Path) -> None:
    (tmp_path / "key-2026").mkdir()
    assert make_backend(f"replay:{tmp_path / 'key-2026'}").ask(request()).state is not None


def test_the_environment_names_a_model() -> None:
    assert model_from_environment({"AEGIS_OT_MODEL": " anthropic:x "}) == "anthropic:x"
    assert model_from_environment({"AEGIS_OT_MODEL": ""}) is None
