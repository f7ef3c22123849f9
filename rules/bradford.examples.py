"""What the rules of protein assays accept and refuse; `aegis-ot rules test` runs each snippet.

A heading says which rules a snippet is for; `deck` stands before all that follow it. Each is the
body of `run`; plate, tubes, reservoir, strips, p20, m20, p300 and m300 are on the deck.
"""

# deck
bsa = {0: tubes["A1"], 125: tubes["A2"], 500: tubes["A3"], 1000: tubes["A4"]}  # ug/mL
samples = [tubes["B1"], tubes["B2"]]
bradford_reagent = reservoir["A1"]
standard_wells = plate.columns()[0][:4]
sample_wells = plate.columns()[0][4:6]

# BRD-1, BRD-2, BRD-3, BRD-4 passes: a fresh tip each time, dye last and mixed
for tube, well in zip(bsa.values(), standard_wells):
    p20.transfer(5, tube, well)
p20.transfer(5, samples, sample_wells, new_tip="always")
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-1, BRD-2 passes: standards from low to high with one tip
p20.pick_up_tip()
for level in sorted(bsa):
    p20.transfer(5, bsa[level], standard_wells[list(bsa).index(level)], new_tip="never")
p20.drop_tip()
p20.transfer(5, samples, sample_wells, new_tip="always")
for well in standard_wells + sample_wells:
    p300.pick_up_tip()
    p300.aspirate(150, bradford_reagent)
    p300.dispense(150, well)
    p300.mix(3, 80, well)
    p300.drop_tip()

# BRD-1 passes: two passes over the standards, each with a tip of its own
for replicate in plate.columns()[:2]:
    p20.transfer(5, list(bsa.values()), replicate[:4], new_tip="once")
    p20.transfer(5, samples, replicate[4:6], new_tip="always")
wells = plate.columns()[0][:6] + plate.columns()[1][:6]
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-1 passes: both replicates of a standard before the next, one tip
pairs = [row[:2] for row in plate.rows()[:4]]
p20.pick_up_tip()
for tube, pair in zip(bsa.values(), pairs):
    p20.transfer(5, tube, pair, new_tip="never")
p20.drop_tip()
p20.transfer(5, samples, sample_wells, new_tip="always")
wells = [well for pair in pairs for well in pair] + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-1 fails: standards from high to low with one tip
p20.pick_up_tip()
for level in sorted(bsa, reverse=True):
    p20.transfer(5, bsa[level], standard_wells[list(bsa).index(level)], new_tip="never")
p20.drop_tip()
p20.transfer(5, samples, sample_wells, new_tip="always")
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-1 fails: the blank comes last
p20.transfer(5, [bsa[125], bsa[500], bsa[1000], bsa[0]], standard_wells, new_tip="once")
p20.transfer(5, samples, sample_wells, new_tip="always")
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-1 fails: the second pass begins with the tip of the first
p20.pick_up_tip()
for replicate in plate.columns()[:2]:
    p20.transfer(5, list(bsa.values()), replicate[:4], new_tip="never")
p20.drop_tip()
p20.transfer(5, samples, sample_wells, new_tip="always")
wells = plate.columns()[0][:6] + plate.columns()[1][:4]
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-1 fails: the standards begin in the blank's well, which has its buffer already
blank_well = plate["A1"]
buffer = tubes["D6"]
p20.transfer(5, buffer, blank_well)
p20.transfer(5, list(bsa.values())[1:], plate.columns()[0][:3], new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="always")
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-1 fails: two standards have changed places
p20.pick_up_tip()
for level in (0, 500, 125, 1000):
    p20.aspirate(5, bsa[level])
    p20.dispense(5, standard_wells[list(bsa).index(level)])
    p20.blow_out()
p20.drop_tip()
p20.transfer(5, samples, sample_wells, new_tip="always")
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-2 passes: replicates of one sample share a tip
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
for sample, row in zip(samples, plate.rows()[4:6]):
    p20.transfer(5, sample, row[:3], new_tip="once")
wells = standard_wells + plate.rows()[4][:3] + plate.rows()[5][:3]
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-2 passes: the dye's own tip stays above the wells, and each is mixed with a fresh one
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="always")
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, [well.top() for well in wells], new_tip="once")
for well in wells:
    p300.pick_up_tip()
    p300.mix(3, 80, well)
    p300.drop_tip()

# BRD-2 fails: one tip for two samples
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="once")
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-2 fails: the tip of the standards goes on to the first sample
p20.pick_up_tip()
for tube, well in zip([*bsa.values(), samples[0]], standard_wells + sample_wells):
    p20.aspirate(5, tube)
    p20.dispense(5, well)
p20.drop_tip()
p20.transfer(5, samples[1], sample_wells[1])
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))

# BRD-2 fails: one tip mixes the dye into all wells
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="always")
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, [well.top() for well in wells], new_tip="once")
p300.pick_up_tip()
for well in wells:
    p300.mix(3, 80, well)
p300.drop_tip()

# BRD-3 passes: more dye than a tip holds, in two draws
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="always")
for well in standard_wells + sample_wells:
    p300.pick_up_tip()
    for _ in range(2):
        p300.transfer(75, bradford_reagent, well.top(-1), new_tip="never")
    p300.mix(3, 80, well)
    p300.drop_tip()

# BRD-3 fails: the samples get no dye
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="always")
p300.transfer(150, bradford_reagent, standard_wells, new_tip="always", mix_after=(3, 80))

# BRD-3 fails: no dye for the blank
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="always")
for well in standard_wells[1:] + sample_wells:
    p300.transfer(150, bradford_reagent, well, mix_after=(3, 80))

# BRD-3 fails: the last sample is left out by one
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="always")
for n in range(5):
    p300.transfer(150, bradford_reagent, plate.wells()[n], mix_after=(3, 80))

# BRD-4 passes: mixed by hand, with a pause of the robot between
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="always")
for well in standard_wells + sample_wells:
    p300.pick_up_tip()
    p300.aspirate(150, bradford_reagent)
    p300.dispense(150, well)
    protocol.delay(seconds=2)
    for _ in range(4):
        p300.aspirate(100, well.bottom(1))
        p300.dispense(100, well.bottom(2))
    p300.drop_tip()

# BRD-4 warns: dye added but not mixed
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
p20.transfer(5, samples, sample_wells, new_tip="always")
p300.transfer(150, bradford_reagent, standard_wells + sample_wells, new_tip="always")

# BRD-4 fails: dye before the samples
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always")
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_after=(3, 80))
p20.transfer(5, samples, sample_wells, new_tip="always", mix_after=(3, 15))

# BRD-4 fails: mixed before the dye, and not behind it
p20.transfer(5, list(bsa.values()), standard_wells, new_tip="always", mix_after=(2, 3))
p20.transfer(5, samples, sample_wells, new_tip="always", mix_after=(2, 3))
wells = standard_wells + sample_wells
p300.transfer(150, bradford_reagent, wells, new_tip="always", mix_before=(2, 100))

# deck
standards = strips.columns()[0]
lysates = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 9, "lysates")
bca_reagent = reservoir["A6"]

# BRD-2, BRD-3, BRD-4 passes: columns at a time, with eight channels
m20.transfer(10, standards[0], plate["A1"])
m20.transfer(10, lysates.rows()[0][:2], plate.rows()[0][1:3], new_tip="always")
m300.transfer(150, bca_reagent, plate.rows()[0][:3], new_tip="always", mix_after=(3, 100))

# BRD-2 fails: eight channels, one set of tips for two columns of lysates
m20.transfer(10, standards[0], plate["A1"])
m20.transfer(10, lysates.rows()[0][:2], plate.rows()[0][1:3], new_tip="once")
m300.transfer(150, bca_reagent, plate.rows()[0][:3], new_tip="always", mix_after=(3, 100))

# BRD-3 fails: a column that gets no reagent
m20.transfer(10, standards[0], plate["A1"])
m20.transfer(10, lysates.rows()[0][:2], plate.rows()[0][1:3], new_tip="always")
m300.transfer(150, bca_reagent, plate.rows()[0][:2], new_tip="always", mix_after=(3, 100))

# BRD-4 warns: eight channels bring the reagent from above, and nothing mixes it
m20.transfer(10, standards[0], plate["A1"])
m20.transfer(10, lysates.rows()[0][:2], plate.rows()[0][1:3], new_tip="always")
m300.transfer(150, bca_reagent, [column.top() for column in plate.rows()[0][:3]], new_tip="once")

# deck
dye = protocol.define_liquid("Coomassie reagent", "", "#3355ff")
reservoir["A3"].load_liquid(dye, 12000)
curve = []
for n, concentration in enumerate((0, 250, 500, 1000)):
    standard = protocol.define_liquid(f"BSA standard {concentration} ug/mL", "", "#999999")
    tubes.rows()[0][n].load_liquid(standard, 300)
    curve.append(tubes.rows()[0][n])
unknown = protocol.define_liquid("unknown", "lysate", "#885522")
for tube in tubes.rows()[1][:2]:
    tube.load_liquid(unknown, 100)
unknowns = tubes.rows()[1][:2]

# BRD-1, BRD-3, BRD-4 passes: tubes known by their liquids, rising
p20.transfer(10, curve, plate.columns()[6][:4], new_tip="once")
p20.transfer(10, unknowns, plate.columns()[7][:2], new_tip="always")
wells = plate.columns()[6][:4] + plate.columns()[7][:2]
p300.transfer(200 - 20, reservoir["A3"], wells, new_tip="always", mix_after=(3, 90))

# BRD-1 fails: tubes known by their liquids, falling
p20.transfer(10, curve[::-1], plate.columns()[6][:4], new_tip="once")
p20.transfer(10, unknowns, plate.columns()[7][:2], new_tip="always")
wells = plate.columns()[6][:4] + plate.columns()[7][:2]
p300.transfer(200 - 20, reservoir["A3"], wells, new_tip="always", mix_after=(3, 90))
