"""Globals that raise at whatever they are asked."""
metadata = {"apiLevel": "2.13"}
class Proxy:
    def __getattribute__(self, name):
        raise RuntimeError("working outside of context: " + name)
class Meta(type):
    def __getattribute__(cls, name):
        raise RuntimeError("no " + name)
class Odd(metaclass=Meta):
    pass
proxy = Proxy()
odd = Odd
class Len(list):
    def __len__(self):
        raise RuntimeError("no len")
    def __iter__(self):
        raise RuntimeError("no iter")
class Eq:
    __hash__ = None
    def __eq__(self, other):
        raise RuntimeError("no eq")
weird = [Len([1, 2]), Eq(), {1: proxy}, {"A1": proxy}]
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    p = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
    local_proxy = proxy
    local = weird
    ws = [plate["A1"], Eq(), proxy]
    p.transfer(20, plate["A1"], plate["B1"])
