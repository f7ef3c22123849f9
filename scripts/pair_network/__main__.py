"""``python -m scripts.pair_network draw OUT.npz [--plates 600] [--seed 101]``
``python -m scripts.pair_network train DRAWN.npz... --out NETWORK.pt [--minutes 30]``
``python -m scripts.pair_network export NETWORK.pt OUT.onnx --learned-from "..."``

It needs ``pip install '.[train]'``, with mitsuba and pyoidn for ``--traced``. How the network ranks
a data set says ``aegis-ot evaluate layer2 DATASET --scorer pair``.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from .strips import draw_pairs, save


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m scripts.pair_network", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    draw = commands.add_parser("draw")
    draw.add_argument("out", type=Path)
    draw.add_argument("--plates", type=int, default=600)
    draw.add_argument("--seed", type=int, default=101)
    draw.add_argument("--traced", action="store_true", help="by the path tracer: needs mitsuba")
    train = commands.add_parser("train")
    train.add_argument("drawn", type=Path, nargs="+")
    train.add_argument("--out", type=Path, required=True)
    train.add_argument("--minutes", type=float, default=30.0)
    train.add_argument("--start", type=Path, help="weights to go on from")
    train.add_argument("--hold", type=float, default=0.0, help="share before steps become smaller")
    write = commands.add_parser("export")
    write.add_argument("weights", type=Path)
    write.add_argument("out", type=Path)
    write.add_argument("--learned-from", required=True, help="for the description")
    asked = parser.parse_args()
    if asked.command == "draw":
        save(asked.out, list(draw_pairs(asked.seed, asked.plates, traced=asked.traced)))
    elif asked.command == "train":
        from .training import train_network

        train_network(asked.drawn, asked.out, 60 * asked.minutes, asked.start, asked.hold)
    else:
        from .export import export

        export(asked.weights, asked.out, asked.learned_from)


if __name__ == "__main__":
    main()
