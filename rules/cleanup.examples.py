"""What the rules of bead clean-ups accept and refuse; `aegis-ot rules test` runs each snippet.

A heading says which rules a snippet is for; `deck` stands before all that follow it. Each is the
body of `run`; plate, tubes, reservoir, strips, p20, m20, p300 and m300 are on the deck.
"""

# deck
ampure_beads, ethanol, elution_buffer = reservoir["A1"], reservoir["A2"], reservoir["A3"]
waste = reservoir["A12"]
samples = plate.rows()[0][:2]
eluates = plate.rows()[0][6:8]

# CLN-1, CLN-2, CLN-3, CLN-4, CLN-5 passes: a tip per column throughout
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(150, samples, waste, new_tip="always")
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))
m300.transfer(38, samples, eluates, new_tip="always")

# CLN-2, CLN-3, CLN-4 passes: buffers from above with one tip
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.transfer(150, ethanol, [well.top() for well in samples], new_tip="once")
m300.transfer(150, samples, waste, new_tip="always")
m300.transfer(40, elution_buffer, [well.top() for well in samples], new_tip="once")
m300.transfer(38, samples, eluates, new_tip="always")

# CLN-1, CLN-4, CLN-5 passes: two washes, each drawn off
sample = samples[0]
m300.transfer(60, ampure_beads, sample, mix_after=(5, 60))
m300.transfer(90, sample, waste)
for _ in range(2):
    m300.transfer(150, ethanol, sample)
    m300.transfer(150, sample, waste)
m300.transfer(40, elution_buffer, sample, mix_after=(5, 30))
m300.transfer(38, sample, eluates[0])

# CLN-1, CLN-2, CLN-3, CLN-5 passes: one tip per column from the beads to the last wash
for sample, eluate in zip(samples, eluates):
    m300.transfer(60, ampure_beads, sample, mix_after=(5, 60))
    m300.pick_up_tip()
    m300.transfer(90, sample, waste.top(), new_tip="never")
    m300.drop_tip()
    m300.transfer(150, ethanol, sample.top())
    m300.transfer(150, sample, waste.top())
    m300.transfer(40, elution_buffer, sample, mix_after=(5, 30))
    m300.transfer(38, sample, eluate)

# CLN-1, CLN-5 passes: one column only
m300.transfer(60, ampure_beads, samples[0], mix_after=(5, 60))
m300.transfer(90, samples[0], waste)
m300.transfer(150, ethanol, samples[0])
m300.transfer(150, samples[0], waste)
m300.transfer(40, elution_buffer, samples[0], mix_after=(5, 30))
m300.transfer(38, samples[0], eluates[0])

# CLN-2, CLN-3, CLN-4 passes: one channel, a tip per sample
sample_wells, clean = plate.columns()[0][:3], plate.columns()[6][:3]
for sample, eluate in zip(sample_wells, clean):
    p300.transfer(60, ampure_beads, sample, mix_after=(5, 60))
    p300.transfer(90, sample, waste.top())
    p300.transfer(150, ethanol, sample.top())
    p300.transfer(150, sample, waste.top())
    p300.transfer(40, elution_buffer, sample, mix_after=(5, 30))
    p300.transfer(38, sample, eluate)

# CLN-1 fails: the second column gets no beads
m300.transfer(60, ampure_beads, samples[0], mix_after=(5, 60))
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(150, samples, waste, new_tip="always")
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))
m300.transfer(38, samples, eluates, new_tip="always")

# CLN-1 fails: the loop over the beads ends early
for sample in samples[:-1]:
    m300.transfer(60, ampure_beads, sample, mix_after=(5, 60))
for sample, eluate in zip(samples, eluates):
    m300.transfer(150, ethanol, sample)
    m300.transfer(150, sample, waste)
    m300.transfer(40, elution_buffer, sample, mix_after=(5, 30))
    m300.transfer(38, sample, eluate)

# CLN-1 fails: beads for one sample of four
tubes_of_samples = plate.columns()[0][:4]
p300.transfer(60, ampure_beads, tubes_of_samples[0], mix_after=(5, 60))
p300.transfer(150, ethanol, tubes_of_samples, new_tip="always")
p300.transfer(150, tubes_of_samples, waste, new_tip="always")
p300.transfer(40, elution_buffer, tubes_of_samples, new_tip="always")

# CLN-1 fails: beads go beside the samples' last column
m300.transfer(60, ampure_beads, [samples[0], plate["A5"]], new_tip="always")
m300.transfer(90, [samples[0], plate["A5"]], waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(150, samples, waste, new_tip="always")

# CLN-2 fails: one tip draws off both columns
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="once")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(150, samples, waste, new_tip="always")
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))
m300.transfer(38, samples, eluates, new_tip="always")

# CLN-2 fails: one tip resuspends both
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.pick_up_tip()
for sample in samples:
    m300.mix(5, 50, sample)
m300.drop_tip()
m300.transfer(40, elution_buffer, samples, new_tip="always")
m300.transfer(38, samples, eluates, new_tip="always")

# CLN-2 fails: one tip carries the eluates over
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(150, samples, waste, new_tip="always")
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))
m300.transfer(38, samples, eluates, new_tip="once")

# CLN-2 fails: a tip that is given back and taken again
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
for sample in samples:
    m300.pick_up_tip(m300.tip_racks[0]["A12"])
    m300.aspirate(90, sample)
    m300.dispense(90, waste.top())
    m300.return_tip()
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))
m300.transfer(38, samples, eluates, new_tip="always")

# CLN-3, CLN-2 fails: the tip mixes in a sample and goes back to the beads
m300.pick_up_tip()
for sample in samples:
    m300.aspirate(60, ampure_beads)
    m300.dispense(60, sample)
    m300.mix(3, 60, sample)
m300.drop_tip()

# CLN-3, CLN-2 fails: ethanol into the wells, and back to the trough
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.pick_up_tip()
for sample in samples:
    m300.transfer(150, ethanol, sample, new_tip="never")
m300.drop_tip()
m300.transfer(200, samples, waste, new_tip="always")
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))

# CLN-3, CLN-2 fails: the elution buffer is mixed in with one tip
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(150, samples, waste, new_tip="always")
m300.transfer(40, elution_buffer, samples, new_tip="once", mix_after=(5, 30))
m300.transfer(38, samples, eluates, new_tip="always")

# CLN-3 fails: one tip a column draws off the wash and then draws ethanol
for sample in samples:
    m300.transfer(60, ampure_beads, sample, mix_after=(5, 60))
    m300.pick_up_tip()
    m300.transfer(90, sample, waste.top(), new_tip="never")
    m300.transfer(150, ethanol, sample.top(), new_tip="never")
    m300.drop_tip()
    m300.transfer(150, sample, waste.top())
    m300.transfer(40, elution_buffer, sample, mix_after=(5, 30))

# CLN-4 fails: the wash is never drawn off
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))
m300.transfer(38, samples, eluates, new_tip="always")

# CLN-4 fails: only the first column's wash is drawn off
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(150, samples[0], waste)
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))
m300.transfer(38, samples, eluates, new_tip="always")

# CLN-4 fails: the second wash stays
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(150, samples, waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))

# CLN-4 fails: a fifth of the wash is drawn off
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(30, samples, waste, new_tip="always")
m300.transfer(40, elution_buffer, samples, new_tip="always", mix_after=(5, 30))

# CLN-5 fails: the second column is never eluted
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
m300.transfer(150, ethanol, samples, new_tip="always")
m300.transfer(150, samples, waste, new_tip="always")
m300.transfer(40, elution_buffer, samples[0], mix_after=(5, 30))
m300.transfer(38, samples[0], eluates[0])

# CLN-5 fails: elution buffer for half a column
sample_wells = plate.columns()[0][:4]
p300.transfer(60, ampure_beads, sample_wells, new_tip="always", mix_after=(5, 60))
p300.transfer(90, sample_wells, waste, new_tip="always")
p300.transfer(40, elution_buffer, sample_wells[:2], new_tip="always", mix_after=(5, 30))

# CLN-5 fails: one well of the list is left out
sample_wells = plate.columns()[0][:4]
p300.transfer(60, ampure_beads, sample_wells, new_tip="always", mix_after=(5, 60))
p300.transfer(90, sample_wells, waste, new_tip="always")
p300.transfer(150, ethanol, sample_wells, new_tip="always")
p300.transfer(150, sample_wells, waste, new_tip="always")
for well in [sample_wells[0], sample_wells[1], sample_wells[3]]:
    p300.transfer(40, elution_buffer, well, mix_after=(5, 30))

# CLN-5 fails: the loop ends one early
m300.transfer(60, ampure_beads, samples, new_tip="always", mix_after=(5, 60))
m300.transfer(90, samples, waste, new_tip="always")
for sample in samples[:-1]:
    m300.transfer(40, elution_buffer, sample, mix_after=(5, 30))
