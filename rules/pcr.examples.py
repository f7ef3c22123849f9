"""What the rules of PCR set-up accept and refuse; `aegis-ot rules test` runs each snippet.

A heading says which rules a snippet is for; `deck` stands before all that follow it. Each is the
body of `run`; plate, tubes, reservoir, strips, p20, m20, p300 and m300 are on the deck.
"""

# deck
master_mix = tubes["A1"]
templates = [tubes["B1"], tubes["B2"]]
positive_control = tubes["B3"]
water = tubes["C1"]
samples = [plate["A1"], plate["B1"]]
pos = plate["C1"]
ntc = plate["D1"]

# PCR-1, PCR-2, PCR-3, PCR-4, PCR-5, PCR-6 passes: a fresh tip for every addition
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, water, ntc)

# PCR-1, PCR-4, PCR-5 passes: one tip of master mix for all wells while they are empty
p20.distribute(4, master_mix, samples + [pos, ntc], disposal_volume=1)
p20.transfer(2, water, ntc)
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")

# PCR-1 fails: the NTC is left out of the master mix
p20.transfer(18, master_mix, samples + [pos], new_tip="always")
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(20, water, ntc)

# PCR-1 fails: the loop stops one sample short
for well in [ntc, pos] + samples[:-1]:
    p20.transfer(18, master_mix, well)
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, water, ntc)

# PCR-1 fails: no master mix for the positive control
p20.distribute(4, master_mix, [*samples, ntc], disposal_volume=1)
p20.transfer(2, water, ntc)
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")

# PCR-2 passes: one tip takes the water to the NTC first
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.pick_up_tip()
p20.transfer(2, water, ntc, new_tip="never")
p20.transfer(2, templates[0], samples[0], new_tip="never")
p20.drop_tip()
p20.transfer(2, [templates[1], positive_control], [samples[1], pos], new_tip="always")

# PCR-2, PCR-5 passes: master mix from above, behind the templates, with one tip
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, water, ntc)
p20.transfer(18, master_mix, [well.top(2) for well in samples + [pos, ntc]], new_tip="once")

# PCR-2 passes: the NTC is mixed with a tip of its own
p20.transfer(18, master_mix, [ntc, pos] + samples, new_tip="always")
for source, well in zip([water, positive_control] + templates, [ntc, pos] + samples):
    p20.pick_up_tip()
    p20.aspirate(2, source)
    p20.dispense(2, well)
    p20.mix(3, 10, well)
    p20.drop_tip()

# PCR-2, PCR-5 fails: one tip for a template and the NTC's water
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, [templates[1], positive_control], [samples[1], pos], new_tip="always")
p20.pick_up_tip()
p20.aspirate(2, templates[0])
p20.dispense(2, samples[0])
p20.blow_out(samples[0].top())
p20.aspirate(2, water.bottom(5))
p20.dispense(2, ntc)
p20.drop_tip()

# PCR-3 passes: one tip for the duplicates of a template
for well in [*samples, plate["A2"], plate["B2"], pos, ntc]:
    p20.transfer(18, master_mix, well)
for template, duplicates in zip(templates, plate.rows()):
    p20.transfer(2, template, duplicates[:2], new_tip="once")
p20.transfer(2, [positive_control, water], [pos, ntc], new_tip="always")

# PCR-3 passes: each well mixed with the tip of its template
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
for template, well in zip(templates + [positive_control], samples + [pos]):
    p20.pick_up_tip()
    p20.transfer(2, template, well, mix_after=(3, 10), new_tip="never")
    p20.drop_tip()
p20.transfer(2, water, ntc)

# PCR-3 fails: one tip for two templates
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, templates, samples, new_tip="once")
p20.transfer(2, positive_control, pos)
p20.transfer(2, water, ntc)

# PCR-3 fails: one tip mixes the filled wells one after the other
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, water, ntc)
p20.pick_up_tip()
for well in samples:
    p20.mix(5, 10, well)
p20.drop_tip()

# PCR-3 fails: a loop that drops its tip too late
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.pick_up_tip()
for template, well in zip(templates + [positive_control], samples + [pos]):
    p20.aspirate(2, template)
    p20.dispense(2, well)
p20.drop_tip()
p20.transfer(2, water, ntc)

# PCR-4 passes: the NTC's volume is made up with water
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
sources = {samples[0]: templates[0], samples[1]: templates[1], pos: positive_control, ntc: water}
for well, source in sources.items():
    p20.transfer(2, source, well)

# PCR-4 fails: the list of templates is one too long
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
wells = samples + [pos, ntc]
p20.transfer(2, templates + [positive_control, templates[0]], wells, new_tip="always")

# PCR-4 fails: the positive control goes into the NTC
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, templates, samples, new_tip="always")
p20.distribute(2, positive_control, [pos, ntc], disposal_volume=0)

# PCR-4 fails: template into the NTC, from above
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, templates[1], ntc.top(-1))

# PCR-5 passes: water is drawn before any template
p20.transfer(2, water, ntc)
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")

# PCR-5 fails: master mix is added after the template with one tip
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, water, ntc)
p20.transfer(18, master_mix, [ntc] + samples[:1], new_tip="once", mix_after=(3, 10))
p20.pick_up_tip()
for _ in range(2):
    p20.aspirate(9, master_mix)
    p20.dispense(9, samples[1])
    p20.mix(3, 10, samples[1])
p20.drop_tip()
p20.transfer(18, master_mix, pos)

# PCR-5 fails: the template's tip goes back into the master mix
p20.transfer(18, master_mix, [ntc, pos] + samples[1:], new_tip="always")
p20.pick_up_tip()
p20.transfer(2, templates[0], samples[0], new_tip="never")
p20.transfer(18, master_mix, samples[0], new_tip="never")
p20.drop_tip()
p20.transfer(2, [templates[1], positive_control, water], [samples[1], pos, ntc], new_tip="always")

# PCR-5 fails: water is drawn with the tip that mixed a reaction
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, [positive_control, water], [pos, ntc], new_tip="always")
p20.transfer(1, templates, samples, new_tip="always")
p20.pick_up_tip()
p20.mix(3, 10, samples[0])
p20.aspirate(1, water)
p20.dispense(1, samples[0])
p20.drop_tip()
p20.transfer(1, water, samples[1])

# PCR-6 warns: the NTC gets no water
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")

# PCR-6 warns: one well gets less master mix
for well, volume in zip(samples + [pos, ntc], [18, 18, 18, 15]):
    p20.transfer(volume, master_mix, well)
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, water, ntc)

# PCR-6 passes: volumes of master mix that are a plan
for row, volume in zip(plate.rows(), (14, 15, 16, 17, 18, 18, 18, 18)):
    p20.transfer(volume, master_mix, row[4:6], new_tip="always")
    p20.transfer(20 - volume, templates[0], row[4:6], new_tip="always")
p20.transfer(18, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, water, ntc)

# PCR-6 warns: one sample gets twice the template
p20.transfer(16, master_mix, samples + [pos, ntc], new_tip="always")
p20.transfer([4, 2, 2], templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, water, ntc)

# PCR-6 warns: one well gets master mix twice
p20.transfer(9, master_mix, samples + [pos, ntc, samples[0]], new_tip="always")
p20.transfer(2, templates + [positive_control], samples + [pos], new_tip="always")
p20.transfer(2, water, ntc)

# deck
master_mix = strips.columns()[0]
dna_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 9, "DNA plate")
qpcr_plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 10, "qPCR plate")
water = reservoir["A1"]
dna, reactions = dna_plate.rows()[0][:3], qpcr_plate.rows()[0][:3]
last_column, ntc = qpcr_plate["A12"], qpcr_plate["H12"]

# PCR-1, PCR-3, PCR-5 passes: columns at a time, with eight channels
m20.transfer(15, master_mix[0], [*reactions, last_column], new_tip="once")
m20.transfer(5, water, last_column)
m20.transfer(5, dna, reactions, new_tip="always")

# PCR-1, PCR-6 passes: master mix for four columns from one draw, water for the last
m20.distribute(4, master_mix[0], [*reactions, last_column], disposal_volume=0)
m20.transfer(5, water, last_column)
for source, column in zip(dna, reactions):
    m20.transfer(5, source, column, mix_after=(3, 5))

# PCR-1 fails: the column with the NTC gets no master mix
m20.transfer(15, master_mix[0], reactions, new_tip="always")
m20.transfer(5, dna, reactions, new_tip="always")
m20.transfer(20, water, last_column)

# PCR-2, PCR-3 fails: the eight tips that brought DNA mix the column with the NTC
m20.transfer(15, master_mix[0], [reactions[0], last_column], new_tip="always")
m20.transfer(5, water, last_column)
m20.pick_up_tip()
m20.transfer(5, dna[0], reactions[0], new_tip="never")
m20.mix(3, 10, last_column)
m20.drop_tip()

# PCR-3 fails: eight channels, one set of tips for two columns of DNA
m20.transfer(15, master_mix[0], [*reactions[:2], last_column], new_tip="once")
m20.transfer(5, water, last_column)
m20.transfer(5, dna[:2], reactions[:2], new_tip="once")

# PCR-4 fails: the columns of DNA reach the NTC
m20.transfer(15, master_mix[0], qpcr_plate.rows()[0][10:], new_tip="once")
m20.transfer(5, dna_plate.rows()[0][10:], qpcr_plate.rows()[0][10:], new_tip="always")

# PCR-5 fails: the tips go back into the strip of master mix
m20.transfer(15, master_mix[0], last_column)
m20.transfer(5, water, last_column)
m20.pick_up_tip()
m20.transfer(5, dna[0], reactions[0], new_tip="never")
m20.transfer(15, master_mix[0], reactions[0], new_tip="never")
m20.drop_tip()

# deck
dna = protocol.define_liquid("genomic DNA", "sample", "#ff0000")
mix = protocol.define_liquid("qPCR master mix", "2x", "#00ff00")
clean_water = protocol.define_liquid("nuclease-free water", "", "#0000ff")
tubes["A1"].load_liquid(mix, 1000)
tubes["A2"].load_liquid(clean_water, 1000)
for tube in tubes.rows()[1][:3]:
    tube.load_liquid(dna, 100)
no_template_control = plate["A12"]

# PCR-2, PCR-4, PCR-6 passes: tubes known by their liquids
p20.transfer(15, tubes["A1"], plate.rows()[0][:3] + [no_template_control], new_tip="always")
p20.transfer(5, tubes["A2"], no_template_control)
p20.transfer(5, tubes.rows()[1][:3], plate.rows()[0][:3], new_tip="always")

# PCR-2 fails: the last tube's tip mixes the no-template control
p20.transfer(15, tubes["A1"], plate.rows()[0][:3] + [no_template_control], new_tip="always")
p20.transfer(5, tubes["A2"], no_template_control)
for tube, well in zip(tubes.rows()[1][:3], plate.rows()[0][:3]):
    p20.pick_up_tip()
    p20.aspirate(5, tube)
    p20.dispense(5, well)
    if tube is tubes["B3"]:
        p20.mix(2, 10, no_template_control)
    p20.drop_tip()

# PCR-2, PCR-5 fails: a tip that was returned comes back for the control
p20.transfer(15, tubes["A1"], plate.rows()[0][:3] + [no_template_control], new_tip="always")
first_tip = tips20["H12"]
p20.pick_up_tip(first_tip)
p20.transfer(5, tubes["B1"], plate["A1"], new_tip="never")
p20.return_tip()
p20.transfer(5, tubes.rows()[1][1:3], plate.rows()[0][1:3], new_tip="always")
p20.pick_up_tip(first_tip)
p20.aspirate(5, tubes["A2"].top(-10))
p20.dispense(5, no_template_control)
p20.drop_tip()

# deck
master_mix_actin, master_mix_gapdh = tubes["A1"], tubes["A2"]
water = reservoir["A12"]
templates = tubes.rows()[3][:3]

# PCR-6 passes: two assays, each with a volume of its own
actin, gapdh = plate.columns()[4][:4], plate.columns()[5][:4]
p20.transfer(18, master_mix_actin, actin, new_tip="once")
p20.transfer(13, master_mix_gapdh, gapdh, new_tip="once")
for wells in (actin, gapdh):
    p20.transfer(2, templates + [water], wells, new_tip="always")
