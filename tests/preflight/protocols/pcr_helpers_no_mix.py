# RT-qPCR, triplicates of each patient sample share a tip
from dataclasses import dataclass

metadata = {"apiLevel": "2.14"}


@dataclass
class Reagent:
    name: str
    tube: object


def run(protocol):
    tip20 = [protocol.load_labware("opentrons_96_filtertiprack_20ul", x) for x in ("10", "11")]
    pip = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tip20)
    pip2 = protocol.load_instrument(
        "p300_single_gen2",
        "right",
        tip_racks=[protocol.load_labware("opentrons_96_filtertiprack_200ul", "9")],
    )
    tubes = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", "2")
    dest = protocol.load_labware("biorad_96_wellplate_200ul_pcr", "3")

    mm = protocol.define_liquid("RT-qPCR master mix", "one step", "#00ff00")
    nuc = protocol.define_liquid("Nuclease-free water", "", "#0000ff")
    tubes["A1"].load_liquid(mm, 1200)
    tubes["A2"].load_liquid(nuc, 500)
    patients = []
    for i in range(4):
        liq = protocol.define_liquid(f"Patient RNA {i + 1}", "", "#ff0000")
        tubes.wells()[8 + i].load_liquid(liq, 50)
        patients.append(tubes.wells()[8 + i])

    def put(pipette, vol, frm, targets):
        pipette.pick_up_tip()
        for t in targets:
            pipette.aspirate(vol, frm)
            pipette.dispense(vol, t.top(-3))
            pipette.blow_out(t.top())
        pipette.drop_tip()

    groups = [dest.rows()[r][0:3] for r in range(4)]
    no_template = dest.rows()[7][0:3]
    put(pip2, 20, tubes["A1"], [w for g in groups for w in g])
    for p, g in zip(patients, groups):
        put(pip, 5, p, g)
    put(pip, 20, tubes["A2"], no_template)
