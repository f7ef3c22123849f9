metadata = {"protocolName": "Dilucion seriada de suero", "apiLevel": "2.15"}


class Serie:
    def __init__(self, ctx):
        self.ctx = ctx
        self.puntas = [ctx.load_labware("opentrons_96_tiprack_300ul", s) for s in (1, 4)]
        self.dep = ctx.load_labware("nest_12_reservoir_15ml", 2)
        self.placa = ctx.load_labware("nest_96_wellplate_200ul_flat", 3)
        self.m = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=self.puntas)
        self.cols = [c[0] for c in self.placa.columns()]

    def agregar_diluyente(self):
        self.m.pick_up_tip()
        for i, c in enumerate(self.cols[1:]):
            self.m.aspirate(100, self.dep.wells()[i // 6])
            self.m.dispense(100, c)
        self.m.drop_tip()

    def agregar_suero(self):
        self.m.transfer(200, self.dep.wells()[2], self.cols[0])

    def diluir(self):
        for a, b in zip(self.cols, self.cols[1:]):
            self.m.transfer(100, a, b, mix_after=(4, 80), new_tip="always")


def run(ctx):
    s = Serie(ctx)
    s.agregar_diluyente()
    s.agregar_suero()
    s.diluir()
