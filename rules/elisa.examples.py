"""What the rules of ELISA accept and refuse; `aegis-ot rules test` runs each snippet.

A heading says which rules a snippet is for; `deck` stands before all that follow it. Each is the
body of `run`; plate, tubes, reservoir, strips, p20, m20, p300 and m300 are on the deck.
"""

# deck
standards = [tubes["A1"], tubes["A2"], tubes["A3"]]  # 0, 100, 500 pg/mL
serum_samples = [tubes["B1"], tubes["B2"]]
detection_antibody, substrate, stop_solution = reservoir["A1"], reservoir["A2"], reservoir["A3"]
waste = reservoir["A12"]
standard_wells = plate.columns()[0][:3]
sample_wells = plate.columns()[1][:2]
wells = standard_wells + sample_wells
above = [well.top() for well in wells]

# ELISA-1, ELISA-2, ELISA-3, ELISA-4, ELISA-5, ELISA-6 passes: reagents from above, wells emptied
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")
p300.transfer(30, stop_solution, above, new_tip="once")

# ELISA-1, ELISA-2, ELISA-3, ELISA-4, ELISA-5, ELISA-6 passes: a fresh tip for each well
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, wells, new_tip="always")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, wells, new_tip="always")
p300.transfer(30, stop_solution, wells, new_tip="always")

# ELISA-1, ELISA-2, ELISA-3, ELISA-4, ELISA-5 passes: a plate washer in a pause
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
protocol.pause("Wash the plate three times in the plate washer and put it back.")
p300.transfer(30, substrate, above, new_tip="once")
p300.transfer(30, stop_solution, above, new_tip="once")

# ELISA-1, ELISA-2, ELISA-3, ELISA-4, ELISA-5, ELISA-6 passes: not stopped, read at once
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-6 passes: washed with buffer and emptied again
wash_buffer = reservoir["A5"]
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(100, wash_buffer, above, new_tip="once")
p300.transfer(100, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-1 fails: the samples get no antibody
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, [well.top() for well in standard_wells], new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-1 fails: the last sample is left out
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above[:-1], new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-1 fails: the antibody goes one column too far
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, standard_wells + plate.columns()[2][:2], new_tip="always")
p300.transfer(50, standard_wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-1 fails: the first standard gets none
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
for well in wells[1:]:
    p300.transfer(30, detection_antibody, well)
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, wells, new_tip="always")

# ELISA-2 fails: one tip for two samples
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="once")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-2 fails: from a sample to a standard with one tip
p20.pick_up_tip()
for tube, well in zip(serum_samples + standards, sample_wells + standard_wells):
    p20.transfer(20, tube, well, new_tip="never")
p20.drop_tip()
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-2 passes: one tip empties all the wells, as a plate washer does
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="once")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-2 fails: the tip goes back from one sample's tube to the next
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.pick_up_tip()
for tube in serum_samples:
    p20.mix(2, 15, tube)
p20.drop_tip()
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-2 fails: replicates of both samples with one tip
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.pick_up_tip()
for tube, pair in zip(serum_samples, (plate.columns()[1][:2], plate.columns()[2][:2])):
    p20.transfer(20, tube, pair, new_tip="never")
p20.drop_tip()

# ELISA-3 fails: the conjugate's tip is kept for the substrate
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.pick_up_tip()
p300.transfer(30, detection_antibody, above, new_tip="never")
protocol.pause("Wash the plate in the plate washer and put it back.")
p300.transfer(30, substrate, above, new_tip="never")
p300.drop_tip()
p300.transfer(30, stop_solution, above, new_tip="once")

# ELISA-3 fails: and for the stop solution as well
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.pick_up_tip()
for reagent in (detection_antibody, substrate, stop_solution):
    p300.transfer(30, reagent, above, new_tip="never")
    protocol.pause("Wash the plate in the plate washer and put it back.")
p300.drop_tip()

# ELISA-3 fails: antibody into the wells, and back to the trough
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, wells, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-3 fails: substrate is mixed in with one tip
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(40, wells, waste, new_tip="always")
p300.transfer(30, substrate, wells, new_tip="once", mix_after=(2, 20))

# ELISA-4 fails: the samples get no substrate
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, [well.top() for well in standard_wells], new_tip="once")

# ELISA-4 fails: the last sample is left out
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, above[:-1], new_tip="once")
p300.transfer(30, stop_solution, above, new_tip="once")

# ELISA-4 fails: the loop over the substrate ends early
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
for well in wells[:-1]:
    p300.transfer(30, substrate, well)

# ELISA-4 fails: the standards get none
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, substrate, sample_wells, new_tip="always")

# ELISA-5 fails: stop before substrate
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, stop_solution, above, new_tip="once")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-5 fails: substrate before the antibody
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")

# ELISA-5 fails: each well gets stop solution and then substrate
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
for well in wells:
    p300.transfer(30, stop_solution, well)
    p300.transfer(30, substrate, well)

# ELISA-5 fails: the samples are stopped too early
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, wells, waste, new_tip="always")
p300.transfer(30, stop_solution, [well.top() for well in sample_wells], new_tip="once")
p300.transfer(30, substrate, above, new_tip="once")
p300.transfer(30, stop_solution, [well.top() for well in standard_wells], new_tip="once")

# ELISA-6 fails: substrate on top of the antibody
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-6 fails: only the standards are emptied
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(50, standard_wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-6 fails: a few µL are drawn off
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(100, detection_antibody, above, new_tip="once")
p300.transfer(20, wells, waste, new_tip="always")
p300.transfer(30, substrate, above, new_tip="once")

# ELISA-6 fails: emptied before the antibody, not after it
p20.transfer(20, standards, standard_wells, new_tip="always")
p20.transfer(20, serum_samples, sample_wells, new_tip="always")
p300.transfer(20, wells, waste, new_tip="always")
p300.transfer(30, detection_antibody, above, new_tip="once")
p300.transfer(30, substrate, above, new_tip="once")
