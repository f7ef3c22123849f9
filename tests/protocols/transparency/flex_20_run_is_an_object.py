"""Its run is an object of a class of its own, with nested functions that share a name."""
metadata = {"apiLevel": "2.20"}
requirements = {"robotType": "Flex"}
class Runner:
    def __init__(self): self.done = []
    def __call__(self, protocol):
        tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
        plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "C2")
        protocol.load_trash_bin("A3")
        p = protocol.load_instrument("flex_1channel_1000", "right", tip_racks=[tips])
        count = 0
        def step():
            nonlocal count
            count += 1
            p.transfer(10 + count, plate["A1"], plate.wells()[count])
            return [step2() for _ in range(2)]
        def step2():
            nonlocal count
            count += 10
            return count
        protocol.comment(str([step(), (lambda: step())(), {k: v for k, v in enumerate(x for x in range(count))}]))
        self.done.append(count)
        protocol.comment(str(sorted(protocol.__dict__)) + str(sorted(vars(p))))
def run(protocol):
    "stands in the text"
run = Runner()
