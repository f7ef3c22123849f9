# expect: pcr pass PCR-1! PCR-2!
"""
Genotyping of zebrafish fins

| position | container          | contents                       |
| (slot)   |                    |                                |
|----------|--------------------|--------------------------------|
| 2        | reaction plate     | A1-A6 fins, A7 no template     |
|          |                    | control                        |
| 5        | tube rack          | C1 PCR mix with primers        |
|          |                    |    (2x, on ice), 300 uL        |
|          |                    | C2 water                       |
| 6        | plate of extracts  | D1-D6 fin DNA of six           |
|          |                    |    fish, 20 uL                 |
"""

metadata = {"protocolName": "fins", "apiLevel": "2.14"}


def run(protocol):
    pl = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tr = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    ex = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 6)
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 9)
    p20 = protocol.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    targets = pl.rows()[0][:7]

    p20.distribute(10, tr["C1"], targets, disposal_volume=0)
    p20.transfer(5, tr["C2"], targets[6])
    for a, b in zip(ex.rows()[3], targets[:6]):
        p20.transfer(5, a, b, mix_after=(2, 10))
