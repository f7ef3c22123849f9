"""What the rules of handling accept and refuse; `aegis-ot rules test` runs each snippet.

A heading says which rules a snippet is for; `deck` stands before all that follow it. Each is the
body of `run`; plate, tubes, reservoir, strips, deepwell, p20, m20, p300 and m300 are on the deck.
"""

# deck
buffer = reservoir["A1"]

# HND-1 passes: columns, named by row A, from a trough
m300.pick_up_tip()
for well in plate.rows()[0][:3]:
    m300.aspirate(30, buffer)
    m300.dispense(30, well)
m300.drop_tip()

# HND-1 passes: one tip of eight, in any row
m300.pick_up_tip(tips300["H1"])
m300.aspirate(30, buffer)
m300.dispense(30, plate["C5"])
m300.drop_tip()

# HND-1 fails: every well of a column, with eight tips each time
m300.pick_up_tip()
for well in plate.columns()[0]:
    m300.aspirate(20, buffer)
    m300.dispense(20, well.top(-2))
m300.drop_tip()

# HND-1 fails: eight tips over a rack with four rows of tubes
m300.transfer(40, tubes["A1"], deepwell["A1"], new_tip="always")

# HND-1 passes: a tip that was put back is there
for _ in range(2):
    p300.pick_up_tip(tips300["B1"])
    p300.transfer(50, buffer, plate["A1"], new_tip="never")
    p300.return_tip()

# HND-1 fails: a place of the rack that is empty by then
for well in plate.rows()[0][:2]:
    p300.pick_up_tip(tips300["B1"])
    p300.transfer(50, buffer, well, new_tip="never")
    p300.drop_tip()

# HND-2 passes: just above the bottom
p300.transfer(50, buffer, plate["A1"].bottom(0.5))

# HND-2 passes: counted from the top, and inside
p300.transfer(50, buffer, plate["A1"].top(-10))

# HND-2 fails: far below the bottom
p300.transfer(50, buffer, deepwell["A1"].bottom(-3))

# HND-2 fails: deeper than the well is, counted from its top
p300.transfer(50, buffer, plate["A1"].top(-20))

# HND-2 warns: pressed on the bottom
p300.transfer(50, plate["A1"].bottom(-0.5), plate["B1"])

# HND-3 passes: repetitions, then the volume
p300.transfer(50, buffer, plate["A1"], mix_after=(3, 40))

# HND-3 passes: a few µL with the pipette that is made for them
p20.transfer(4, tubes["A1"], plate.rows()[0][:3], new_tip="always")

# HND-3 warns: the volume, then the repetitions
p300.transfer(60, buffer, plate["A1"], mix_after=(40, 3))

# HND-3 warns: a few µL with a pipette for 20 to 300 µL
p300.transfer(4, buffer, plate.rows()[0][:3], new_tip="always")

# HND-4 passes: what need not be topped up is left out
for well, volume in zip(plate.rows()[0], (40, 0, 25)):
    if volume:
        p300.transfer(volume, buffer, well, new_tip="always")

# HND-4 passes: the air gap is given with the liquid
p300.pick_up_tip()
p300.aspirate(80, buffer)
p300.air_gap(20)
p300.dispense(100, plate["A1"])
p300.drop_tip()

# HND-4 fails: 0 µL more than the tip holds are all that it holds
p300.pick_up_tip()
p300.aspirate(100, buffer)
for well, volume in zip(plate.rows()[0], (40, 0, 60)):
    p300.dispense(volume, well)
p300.drop_tip()

# HND-4 fails: four times 80 µL out of 250 µL
p300.pick_up_tip()
p300.aspirate(250, buffer)
for well in plate.rows()[0][:4]:
    p300.dispense(80, well)
p300.drop_tip()

# HND-4 warns: the tip is emptied into a spare tube, with a volume that is sure to do
for row in plate.rows()[:3]:
    p300.pick_up_tip()
    p300.aspirate(250, buffer)
    for well in row[:4]:
        p300.dispense(50, well.top(-1))
    p300.dispense(100, tubes["D6"].top(-1))
    p300.drop_tip()

# HND-4 fails: the last of several written out, on the plate that the others went to
p300.pick_up_tip()
p300.aspirate(250, buffer)
p300.dispense(100, plate["A1"])
p300.dispense(100, plate["A2"])
p300.dispense(100, plate["A3"])
p300.drop_tip()

# HND-4 fails: what is cut short in a tube is drawn from later
p300.pick_up_tip()
p300.aspirate(250, buffer)
p300.dispense(200, plate["A1"])
p300.dispense(100, tubes["D6"])
p300.drop_tip()
p300.transfer(40, tubes["D6"], plate["B1"])

# HND-4 fails: distribute ends at the first well, whose share has no room in a smaller tip
filters = protocol.load_labware("opentrons_96_filtertiprack_200ul", 9)
p300.tip_racks = [filters]
p300.distribute(190, buffer, deepwell.rows()[0][:6])

# HND-4 passes: distribute with room for the disposal volume
filters = protocol.load_labware("opentrons_96_filtertiprack_200ul", 9)
p300.tip_racks = [filters]
p300.distribute(90, buffer, deepwell.rows()[0][:6])

# HND-4 warns: the air gap leaves first, and 20 of 80 µL stay in the tip
p300.pick_up_tip()
p300.aspirate(80, buffer)
p300.air_gap(20)
p300.dispense(80, plate["A1"])
p300.drop_tip()

# HND-4 warns: the air gap after the dispense draws liquid
p300.pick_up_tip()
p300.aspirate(80, buffer)
p300.dispense(80, plate["A1"].bottom(1))
p300.aspirate(20, plate["A1"].bottom(1))
p300.drop_tip()

# HND-5 passes: all wells that are pooled were filled
p300.transfer(50, buffer, plate.rows()[0][:6], new_tip="once")
p300.consolidate(30, plate.rows()[0][:6], tubes["D6"])

# HND-5 passes: the plate was filled by hand, and the run only adds a reaction's last part
p300.transfer(10, buffer, plate.rows()[0][:6], new_tip="always", mix_after=(2, 20))

# HND-5 warns: row A is filled, and row B given on
p300.transfer(50, buffer, plate.rows()[0][:6], new_tip="once")
p300.transfer(30, plate.rows()[1][:6], deepwell.rows()[0][:6], new_tip="always")

# HND-5 warns: a well is mixed that nothing was put into
p300.transfer(50, buffer, plate.rows()[0][:6], new_tip="once")
p300.pick_up_tip()
p300.mix(3, 30, plate["A7"])
p300.drop_tip()

# HND-5 warns: six wells are filled, and eight pooled
p300.transfer(50, buffer, plate.rows()[0][:6], new_tip="once")
p300.consolidate(30, plate.rows()[0][:8], tubes["D6"])

# HND-6 passes: two tubes for 48 wells
for tube, rows in zip(tubes.wells(), (plate.rows()[:2], plate.rows()[2:4])):
    p300.transfer(60, tube, rows, new_tip="once")

# HND-6 passes: what is drawn to mix goes back
for _ in range(3):
    p300.transfer(200, tubes["A1"], deepwell["A1"], mix_before=(5, 250))

# HND-6 passes: an empty rack is given four tips, so four of eight channels draw
rack = protocol.load_labware("opentrons_96_tiprack_300ul", 9)
for column, row in enumerate("ACEG"):
    m300.pick_up_tip(tips300.rows()[7][column])
    m300.drop_tip(rack[f"{row}1"])
m300.pick_up_tip(rack["A1"])
for column in deepwell.rows()[0]:
    m300.transfer(250, reservoir["A1"], column, new_tip="never")
m300.drop_tip()

# HND-6 fails: a channel of a reservoir for more than it holds
for column in range(4):
    m300.transfer(250, reservoir["A1"], [deepwell.rows()[0][column]] * 3, new_tip="once")

# HND-6 fails: one 2 mL tube for 48 wells
p300.transfer(60, tubes["A1"], plate.rows()[:4], new_tip="once")
