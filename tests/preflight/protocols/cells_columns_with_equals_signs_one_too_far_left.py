# expect: cell_treatment warn CELL-1
# estradiol on starved MCF-7
# cols: 1 = untreated, 2 = EtOH (vehicle), 3 = 1 nM, 4 = 10 nM, 5 = 100 nM
metadata = {"apiLevel": "2.12", "protocolName": "E2 response"}


def run(protocol):
    mcf7 = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "MCF-7")
    strip = protocol.load_labware("nest_12_reservoir_15ml", 2)
    box = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    multi = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=[box])
    etoh = strip["A1"]
    e2 = [strip["A2"], strip["A3"], strip["A4"]]  # estradiol 1, 10, 100 nM

    multi.transfer(50, etoh, mcf7["A2"])
    for solution, well in zip(e2, ["A2", "A3", "A4"]):
        multi.transfer(50, solution, mcf7[well])
