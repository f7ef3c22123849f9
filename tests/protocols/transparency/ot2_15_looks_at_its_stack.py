"""A protocol that asks who called it: inspect.stack, currentframe, traceback."""
import inspect
import traceback

metadata = {"apiLevel": "2.15"}


def where():
    return inspect.currentframe().f_back.f_lineno


def caller():
    return inspect.stack()[1].function


def step(pipette, source, target):
    pipette.transfer(50, source, target)
    return caller()


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    protocol.comment(f"{where()} {caller()} {step(pipette, plate['A1'], plate['A2'])}")
    protocol.comment(traceback.extract_stack()[-1].name)
    protocol.comment(str(list(inspect.signature(run).parameters)))
    try:
        pipette.aspirate(50, plate["A1"])
    except Exception as error:
        protocol.comment(f"{type(error).__name__} {traceback.extract_tb(error.__traceback__)[0].name}")
