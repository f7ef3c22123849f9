"""What the rules of plain transfers accept and refuse; `aegis-ot rules test` runs each snippet.

A heading says which rules a snippet is for; `deck` stands before all that follow it. Each is the
body of `run`; plate, tubes, reservoir, strips, deepwell, p20, m20, p300 and m300 are on the deck.
"""

# deck
sources = tubes.columns()[0][:3]
destinations = plate.columns()[0][:3]
water = reservoir["A1"]
pool = tubes["D6"]

# GEN-1, GEN-2 passes: water first, into empty wells, then a fresh tip for each source
p300.transfer(50, water, destinations, new_tip="once")
p300.transfer(50, sources, destinations, new_tip="always")

# GEN-1 passes: pooling with one tip
p300.consolidate(50, sources, pool)

# GEN-1 warns: a tip that mixed in the pool goes back into its library for the second half
for library in sources:
    p300.pick_up_tip()
    for _ in range(2):
        p300.transfer(20, library, pool, mix_after=(2, 40), new_tip="never")
    p300.drop_tip()

# GEN-1 passes: each source into two wells, with a tip of its own
for source, row in zip(sources, plate.rows()):
    p300.distribute(40, source, row[:2])

# GEN-1 warns: one tip for all sources, which only a variable names
p300.transfer(50, sources, destinations, new_tip="once")

# GEN-1 fails: one tip for all sources, each loaded under a name of its own
for number, source in enumerate(sources):
    source.load_liquid(protocol.define_liquid(f"lysate {number}", "", "#cc9966"), 900)
p300.transfer(50, sources, destinations, new_tip="once")

# GEN-1 fails: one tip mixes what stands in the destinations, from a labelled rack
patients = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 9, "patient samples")
p300.transfer(50, patients.wells()[:3], destinations, new_tip="always")
p300.pick_up_tip()
for destination in destinations:
    p300.mix(2, 30, destination)
p300.drop_tip()

# GEN-1 passes: one tip for three tubes of one reagent, each for two wells
for source in sources:
    source.load_liquid(protocol.define_liquid("antibody", "", "#ffffff"), 900)
p300.pick_up_tip()
for source, row in zip(sources, plate.rows()):
    p300.transfer(50, source, row[:2], new_tip="never")
p300.drop_tip()

# GEN-1 fails: one tip for samples that share their liquid's name
for source in sources:
    source.load_liquid(protocol.define_liquid("Sample", "", "#ffffff"), 900)
p300.transfer(50, sources, destinations, new_tip="once")

# GEN-1 passes: the moves are tried out, and all goes back where it came from
p300.pick_up_tip()
for well in [*sources, *destinations]:
    p300.aspirate(50, well)
    p300.dispense(50, well)
p300.drop_tip()

# GEN-1 warns: one tip for all of them, and nothing says what they are
p300.transfer(50, deepwell.rows()[0][:3], plate.rows()[0][:3], new_tip="once")

# GEN-1 warns: the tip is dropped outside the loop, which only a variable names
p300.pick_up_tip()
for source, destination in zip(sources, destinations):
    p300.aspirate(50, source)
    p300.dispense(50, destination)
    p300.blow_out()
p300.drop_tip()

# GEN-1 warns: one tip mixes what stands in the destinations, which only a variable names
p300.transfer(50, sources, destinations, new_tip="always")
p300.pick_up_tip()
for destination in destinations:
    p300.mix(2, 30, destination)
p300.drop_tip()

# GEN-2 passes: water behind the sources, from above
p300.transfer(50, sources, destinations, new_tip="always")
p300.transfer(50, water, [well.top() for well in destinations], new_tip="once")

# GEN-2 passes: a fresh tip for each well that is topped up and mixed
p300.transfer(50, sources, destinations, new_tip="always")
p300.transfer(50, water, destinations, new_tip="always", mix_after=(2, 40))

# GEN-2, GEN-1 fails: water is added to filled wells with one tip
p300.transfer(50, sources, destinations, new_tip="always")
p300.transfer(50, water, destinations, new_tip="once", mix_after=(2, 40))

# GEN-2 fails: a second draw of water with the tip that stood in the well
p300.transfer(20, sources, destinations, new_tip="always")
for destination in destinations:
    p300.pick_up_tip()
    for _ in range(2):
        p300.aspirate(40, water)
        p300.dispense(40, destination.bottom(1))
        p300.mix(1, 30, destination)
    p300.drop_tip()

# GEN-2, GEN-1 warns: the tip is rinsed twice before it goes back into the water
waste = reservoir["A12"]
washes = [reservoir["A10"], reservoir["A11"]]
p300.transfer(50, sources, destinations, new_tip="always")
p300.pick_up_tip()
for destination in destinations:
    p300.transfer(40, water, destination, mix_after=(2, 40), new_tip="never")
    for wash in washes:
        p300.transfer(100, wash, waste.top(-5), new_tip="never")
p300.drop_tip()

# GEN-2, GEN-1 fails: one rinse is not enough
waste, wash = reservoir["A12"], reservoir["A11"]
p300.transfer(50, sources, destinations, new_tip="always")
p300.pick_up_tip()
for destination in destinations:
    p300.transfer(40, water, destination, mix_after=(2, 40), new_tip="never")
    p300.transfer(100, wash, waste.top(-5), new_tip="never")
p300.drop_tip()

# GEN-2 warns: water goes into a second reagent with the tip, and all wells get both of them
metal_mix = reservoir["A3"]
p300.transfer(90, water, destinations, new_tip="once")
p300.transfer(30, metal_mix, destinations, new_tip="once")
p300.transfer(30, sources, destinations, new_tip="always")

# GEN-3 passes: exactly full
p300.transfer(200, tubes["A1"], plate["A1"])

# GEN-3 passes: all is taken out again, and a little air with it
p300.transfer(100, sources[0], destinations[0])
p300.transfer(100, destinations[0], pool)

# GEN-3 fails: a 200 µL well gets 500 µL
for _ in range(2):
    p300.transfer(250, sources[0], destinations[0])

# GEN-3 fails: more is drawn than was put in
p300.transfer(60, sources[0], destinations[0])
p300.transfer(80, destinations[0], plate["B1"])

# GEN-3 fails: a loop fills the pool's tube over
for _ in range(12):
    p300.transfer(200, sources[0], pool)

# GEN-3 warns: more is declared than the tube holds, and the run adds nothing to it
tubes["A6"].load_liquid(protocol.define_liquid("trypsin", "", "#9900ff"), 2500)
p300.transfer(100, tubes["A6"], destinations, mix_before=(1, 150))

# GEN-3 warns: drops that fall from high over a tube may not all be in it
p300.transfer(200, sources[0], [pool.top(30)] * 12)

# deck
donors = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 9, "source plate")
copies = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 10, "destination plate")
buffer = reservoir["A2"]

# GEN-1, GEN-2 passes: a plate is copied column by column, with eight channels
m300.transfer(100, buffer, copies.rows()[0][:3], new_tip="once")
m300.transfer(50, donors.rows()[0][:3], copies.rows()[0][:3], new_tip="always")

# GEN-1 fails: a plate is copied with one set of tips
m300.transfer(50, donors.rows()[0][:3], copies.rows()[0][:3], new_tip="once")

# GEN-2, GEN-1 fails: the tips that mixed the copies go back into the buffer
m300.transfer(50, donors.rows()[0][:3], copies.rows()[0][:3], new_tip="always")
m300.pick_up_tip()
for column in copies.rows()[0][:3]:
    m300.aspirate(100, buffer)
    m300.dispense(100, column)
    m300.mix(2, 80, column)
m300.drop_tip()

# deck
elution = protocol.define_liquid("elution buffer", "", "#99ccff")
extract = protocol.define_liquid("sample", "", "#cc9966")
reservoir["A4"].load_liquid(elution, 400)
for tube in tubes.rows()[2][:3]:
    tube.load_liquid(extract, 120)
samples = tubes.rows()[2][:3]
targets = plate.rows()[3][:3]

# GEN-2, GEN-3 passes: normalised by a table, as far as the loaded liquids go
for sample, target, volume in zip(samples, targets, (20, 35, 50)):
    p300.transfer(100 - volume, reservoir["A4"], target)
    p300.transfer(volume, sample, target, mix_after=(2, 50))

# GEN-2, GEN-1 fails: normalised by a table, buffer last and with one tip
for sample, target, volume in zip(samples, targets, (20, 35, 50)):
    p300.transfer(volume, sample, target)
p300.pick_up_tip()
for target, volume in zip(targets, (20, 35, 50)):
    p300.aspirate(100 - volume, reservoir["A4"])
    p300.dispense(100 - volume, target.bottom(0.5))
    p300.mix(2, 40, target)
p300.drop_tip()

# GEN-3 passes: air gaps are no volume
for sample, target in zip(samples, targets):
    p300.transfer(120, sample, target, air_gap=20)

# GEN-3 warns: the table asks for more than the tube holds
for sample, target, volume in zip(samples, targets, (60, 110, 190)):
    p300.transfer(volume, sample, target)

# GEN-3 warns: the second draw lacks 2 of 61 µL
p300.transfer(61, samples[0], targets[:2], new_tip="always")

# deck
source_rack, dest_plate = tubes, plate

# GEN-1 warns: one tip for all sources, named by the rack's variable alone
p300.transfer(50, source_rack.wells()[:3], dest_plate.wells()[:3], new_tip="once")

# deck
sample_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 9)
water = reservoir["A1"]

# GEN-1 warns: a plate named for samples gets nothing but water, and may yet be empty
p300.pick_up_tip()
p300.aspirate(200, water)
for well in sample_plate.rows()[0][:3]:
    p300.dispense(20, well)
    p300.touch_tip()
p300.drop_tip()

# deck
cells = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 9, "HeLa cells").wells()[:4]
medium, waste = reservoir["A1"], reservoir["A12"]

# GEN-2 fails: the tip that drew the old medium off the cells goes into the fresh one
p300.pick_up_tip()
for well in cells:
    p300.transfer(200, well, waste.top(), new_tip="never")
    p300.transfer(200, medium, well.top(), new_tip="never")
p300.drop_tip()

# GEN-2 passes: a tip for the old medium, another one for the fresh one
p300.transfer(200, cells, waste.top(), new_tip="always")
p300.transfer(200, medium, [well.top() for well in cells], new_tip="once")
