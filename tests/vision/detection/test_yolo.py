"""A user's own detector, stood in for by a small network that finds a red patch."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import onnx
import pytest
from onnx import TensorProto, helper, numpy_helper

from aegis_ot.errors import ModelError
from aegis_ot.vision.detection import YoloDetector, load_detector
from aegis_ot.vision.detection.edges import axis_in_box

SIDE = 160


def save(path: Path, nodes: list, constants: dict, output_shape: list, inputs: int = 1) -> Path:
    graph = helper.make_graph(
        nodes,
        "stub",
        [
            helper.make_tensor_value_info(f"images{i or ''}", TensorProto.FLOAT, [1, 3, SIDE, SIDE])
            for i in range(inputs)
        ],
        [helper.make_tensor_value_info("output0", TensorProto.FLOAT, output_shape)],
        [
            numpy_helper.from_array(
                np.asarray(v, np.float32 if np.asarray(v).dtype.kind == "f" else np.int64), k
            )
            for k, v in constants.items()
        ],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=8)
    onnx.checker.check_model(model)
    onnx.save(model, path)
    return path


@pytest.fixture
def red_finder(tmp_path: Path) -> Path:
    """Five boxes: one on the centre of what is red in the letterboxed RGB image, four weak."""
    xs, ys = np.meshgrid(np.arange(SIDE) + 0.5, np.arange(SIDE) + 0.5)
    constants = {
        "c0": [0], "c1": [1], "c2": [2], "axis1": [1], "axis4": [1, 2, 3], "half": [0.5],
        "xs": xs[None, None].astype(np.float32), "ys": ys[None, None].astype(np.float32),
        "tiny": [1e-3], "fifty": [50.0], "rest": np.float32([20, 60]).reshape(1, 2, 1),
        "weak": np.array([30, 30, 10, 10, 0.3], np.float32).reshape(1, 5, 1), "column": [1, 1, 1],
    }  # fmt: skip
    node = helper.make_node
    nodes = [
        node("Slice", ["images", "c0", "c1", "axis1"], ["red"]),
        node("Slice", ["images", "c1", "c2", "axis1"], ["green"]),
        node("Sub", ["red", "green"], ["redness"]),
        node("Greater", ["redness", "half"], ["mask"]),
        node("Cast", ["mask"], ["weight"], to=TensorProto.FLOAT),
        node("ReduceSum", ["weight", "axis4"], ["total"], keepdims=1),
        node("Add", ["total", "tiny"], ["area"]),
        *[
            step
            for axis in ("xs", "ys")
            for step in (
                node("Mul", ["weight", axis], [f"{axis}_w"]),
                node("ReduceSum", [f"{axis}_w", "axis4"], [f"{axis}_sum"], keepdims=1),
                node("Div", [f"{axis}_sum", "area"], [f"{axis}_mean"]),
                node("Reshape", [f"{axis}_mean", "column"], [f"{axis}_out"]),
            )
        ],
        node("Div", ["total", "fifty"], ["raw"]),
        node("Clip", ["raw", "", "one"], ["clipped"]),
        node("Reshape", ["clipped", "column"], ["score"]),
        node("Concat", ["xs_out", "ys_out", "rest", "score"], ["strong"], axis=1),
        node("Concat", ["weak", "strong", "weak", "weak", "weak"], ["output0"], axis=2),
    ]
    constants["one"] = np.float32(0.9)
    return save(tmp_path / "red.onnx", nodes, constants, [1, 5, 5])


def red_frame(width: int, height: int, x: int, y: int) -> np.ndarray:
    image = np.full((height, width, 3), 40, np.uint8)
    cv2.rectangle(image, (x - 20, y - 40), (x + 19, y + 39), (0, 0, 255), -1)
    return image


@pytest.mark.parametrize("size", [(640, 480), (960, 540), (480, 640)])
def test_a_box_goes_back_through_the_letterbox(red_finder: Path, size: tuple[int, int]) -> None:
    found = YoloDetector(red_finder).detect(red_frame(*size, 300, 250))
    assert found is not None
    scale = max(size) / SIDE
    assert (found.x + found.w / 2, found.y + found.h / 2) == pytest.approx((300, 250), abs=2)
    assert (found.w, found.h) == pytest.approx((20 * scale, 60 * scale), abs=1)
    assert found.confidence == pytest.approx(0.9)


def test_nothing_red_is_no_tip(red_finder: Path) -> None:
    assert YoloDetector(red_finder).detect(np.full((480, 640, 3), 40, np.uint8)) is None


def test_the_threshold_is_a_setting(red_finder: Path) -> None:
    blank = np.full((480, 640, 3), 40, np.uint8)
    found = YoloDetector(red_finder, threshold=0.2).detect(blank)
    assert found is not None
    assert found.confidence == pytest.approx(0.3)


def test_a_path_without_a_description_is_taken_for_a_yolo_export(red_finder: Path) -> None:
    assert isinstance(load_detector(str(red_finder)), YoloDetector)


def test_another_class_is_not_the_tip(red_finder: Path) -> None:
    with pytest.raises(ModelError, match=r"\(1, 5, 5\)"):
        YoloDetector(red_finder, tip_class=1).detect(red_frame(640, 480, 200, 150))


def test_a_file_that_is_no_network_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.onnx").write_bytes(b"not a network")
    with pytest.raises(ModelError, match=r"x\.onnx"):
        load_detector(tmp_path / "x.onnx")


def test_a_network_with_two_inputs_is_refused(tmp_path: Path) -> None:
    nodes = [helper.make_node("Add", ["images", "images1"], ["output0"])]
    path = save(tmp_path / "two.onnx", nodes, {}, [1, 3, SIDE, SIDE], inputs=2)
    with pytest.raises(ModelError, match="2 inputs"):
        YoloDetector(path)


def test_an_output_of_another_layout_is_refused(tmp_path: Path) -> None:
    nodes = [helper.make_node("Identity", ["images"], ["output0"])]
    path = save(tmp_path / "same.onnx", nodes, {}, [1, 3, SIDE, SIDE])
    with pytest.raises(ModelError, match="expected"):
        YoloDetector(path).detect(red_frame(640, 480, 200, 150))


def fixed_table(path: Path, table: np.ndarray, names: str = "") -> Path:
    """A network that gives the same table whatever it sees."""
    node = helper.make_node
    nodes = [
        node("ReduceMean", ["images"], ["mean"], axes=[1, 2, 3], keepdims=0),
        node("Mul", ["mean", "none"], ["zero"]),
        node("Add", ["table", "zero"], ["output0"]),
    ]
    constants = {"none": np.float32([0.0]), "table": table.astype(np.float32)}
    save(path, nodes, constants, list(table.shape))
    if names:
        model = onnx.load(path)
        helper.set_model_props(model, {"names": names})
        onnx.save(model, path)
    return path


def test_an_export_that_sorted_its_boxes_out_is_refused(tmp_path: Path) -> None:
    path = fixed_table(tmp_path / "nms.onnx", np.zeros((1, 300, 6)))
    with pytest.raises(ModelError, match=r"nms\.onnx .*\(1, 300, 6\).*nms=True"):
        YoloDetector(path)


def test_boxes_in_fractions_are_refused(tmp_path: Path) -> None:
    table = np.tile(np.float32([0.5, 0.5, 0.05, 0.3, 0.9])[None, :, None], (1, 1, 8))
    path = fixed_table(tmp_path / "fractions.onnx", table)
    with pytest.raises(ModelError, match="fractions"):
        YoloDetector(path).detect(np.zeros((480, 640, 3), np.uint8))


def test_the_class_named_tip_is_found(tmp_path: Path) -> None:
    table = np.zeros((1, 6, 8))
    table[0, :4] = np.array([80, 80, 10, 60])[:, None]
    table[0, 5] = 0.8
    image = np.zeros((480, 640, 3), np.uint8)
    unnamed = fixed_table(tmp_path / "unnamed.onnx", table)
    named = fixed_table(tmp_path / "named.onnx", table, "{0: 'tiprack', 1: 'Pipette_Tip'}")
    assert YoloDetector(unnamed).detect(image) is None
    assert YoloDetector(unnamed, tip_class=1).detect(image) is not None
    found = YoloDetector(named).detect(image)
    assert found is not None
    assert found.confidence == pytest.approx(0.8)


def test_a_class_that_the_network_lacks_is_refused_when_it_is_loaded(red_finder: Path) -> None:
    with pytest.raises(ModelError, match="class 3"):
        YoloDetector(red_finder, tip_class=3)


def test_the_axis_follows_a_leaning_tip() -> None:
    image = np.full((480, 640, 3), 30, np.uint8)
    outline = np.array([[290, 100], [320, 100], [324, 300], [318, 300]])
    cv2.fillPoly(image, [outline], (160, 160, 160), cv2.LINE_AA)
    collar, orifice = axis_in_box(image, 285, 100, 42, 200)
    assert collar == pytest.approx((305, 100), abs=3)
    assert orifice == pytest.approx((321, 300), abs=3)


def test_a_box_without_edges_has_its_centre_line_as_axis() -> None:
    image = np.full((480, 640, 3), 30, np.uint8)
    assert axis_in_box(image, 100, 50, 30, 200) == ((115, 50), (115, 250))
    assert axis_in_box(image, 100, 50, 3, 8) == ((101.5, 50), (101.5, 58))
