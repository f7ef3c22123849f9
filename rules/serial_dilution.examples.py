"""What the rules of serial dilutions accept and refuse; `aegis-ot rules test` runs each snippet.

A heading says which rules a snippet is for; `deck` stands before all that follow it. Each is the
body of `run`; plate, tubes, reservoir, deepwell, p20, m20, p300 and m300 are on the deck.
"""

# deck
diluent = reservoir["A1"]
stock = tubes["A1"]
series = plate.rows()[0][:6]

# SD-1, SD-2, SD-3, SD-4, SD-5 passes: diluent first, then well to well, mixed, with fresh tips
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, mix_after=(3, 80), new_tip="always")

# SD-1, SD-5 passes: stock into diluent, each step mixed by hand and its surplus thrown away
p300.transfer(100, diluent, series, new_tip="once")
sources = [stock, *series[:-1]]
for source, target in zip(sources, series):
    p300.pick_up_tip()
    p300.aspirate(50, source)
    p300.dispense(50, target)
    for _ in range(3):
        p300.aspirate(60, target)
        p300.dispense(60, target)
    p300.drop_tip()
p300.pick_up_tip()
p300.aspirate(50, series[-1])
p300.drop_tip()

# SD-1, SD-2 passes: the source is mixed before each step, and the last well at the end
p300.transfer(100, diluent, series[1:], new_tip="once")
p300.transfer(150, stock, series[0])
for n in range(5):
    p300.transfer(50, series[n], series[n + 1], mix_before=(3, 50))
p300.pick_up_tip()
p300.mix(3, 50, series[5])
p300.drop_tip()

# SD-1 fails: no mixing between the steps
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, new_tip="always")

# SD-1 fails: the last step is not mixed
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
for left, right in zip(series[:-2], series[1:-1]):
    p300.transfer(50, left, right, mix_after=(3, 80))
p300.transfer(50, series[-2], series[-1])

# SD-1 fails: one step is mixed in the well that it came from
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
for n, (left, right) in enumerate(zip(series, series[1:])):
    p300.pick_up_tip()
    p300.aspirate(50, left)
    p300.dispense(50, right)
    p300.mix(3, 60, left if n == 2 else right)
    p300.drop_tip()

# SD-2 passes: down a column, with the list of wells turned round
wells = plate.columns()[3][::-1]
p300.distribute(90, diluent, wells[1:])
p300.transfer(100, stock, wells[0])
for n in range(7):
    p300.transfer(20 if n else 30, wells[n], wells[n + 1], mix_after=(5, 50))

# SD-2 passes: factors that skip no well, over two rows
long_series = plate.rows()[2][:5] + plate.rows()[3][:5]
p300.distribute(90, diluent, long_series[1:])
p300.transfer(180, stock, long_series[0])
for n in range(9):
    p300.transfer(30, long_series[n], long_series[n + 1], mix_after=(5, 60))

# SD-2 fails: the chain runs towards the stock
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
for right, left in zip(series[::-1], series[-2::-1]):
    p300.transfer(50, right, left, mix_after=(3, 80), new_tip="always")

# SD-2 fails: one step draws from the well before the last
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
for n in range(5):
    source = series[n] if n != 3 else series[n - 1]
    p300.transfer(50, source, series[n + 1], mix_after=(3, 80))

# SD-2 fails: two wells are taken in the wrong order
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
for left, right in [(0, 1), (1, 3), (3, 2), (2, 4), (4, 5)]:
    p300.transfer(50, series[left], series[right], mix_after=(3, 80))

# SD-3 passes: no diluent for the undiluted stock
p300.transfer(150, stock, series[0])
for well in series[1:]:
    p300.transfer(100, diluent, well)
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, mix_after=(3, 80))

# SD-3 passes: each well is filled just before its step
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(100, diluent, right)
    p300.transfer(50, left, right, mix_after=(3, 80))

# SD-3 fails: the diluent comes after the chain
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, mix_after=(3, 80), new_tip="always")
p300.transfer(100, diluent, series[1:], new_tip="always")

# SD-3 fails: the diluent forgets the last well
p300.distribute(100, diluent, series[1:-1])
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, mix_after=(3, 30))

# SD-3 fails: within a step the diluent comes second
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right)
    p300.transfer(100, diluent, right, mix_after=(3, 80))

# SD-4 passes: diluent from two bottles that are called so
diluents = [reservoir["A2"], reservoir["A3"]]
for n, well in enumerate(series[1:]):
    p300.transfer(100, diluents[n % 2], well)
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, mix_after=(3, 80))

# SD-4 passes: a blank of diluent behind the series
blank = plate["H1"]
p300.distribute(100, diluent, [*series[1:], blank])
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, mix_after=(3, 80))

# SD-4 fails: the wells are filled from the stock
p300.distribute(100, stock, series[1:])
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, mix_after=(3, 80), new_tip="always")

# SD-4 fails: one well gets stock in the diluent's place
for n, well in enumerate(series[1:]):
    p300.transfer(100, stock if n == 2 else diluent, well)
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, mix_after=(3, 80))

# SD-5 passes: one tip makes one step, and mixes what it has made
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
for left, right in zip(series, series[1:]):
    p300.pick_up_tip()
    p300.mix(2, 40, left)
    p300.aspirate(50, left)
    p300.dispense(50, right)
    p300.mix(3, 80, right)
    p300.drop_tip()

# SD-5 warns: one tip through the whole series, mixed at each step
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
p300.pick_up_tip()
for left, right in zip(series, series[1:]):
    p300.transfer(50, left, right, mix_after=(3, 80), new_tip="never")
p300.drop_tip()

# SD-5 warns: a fresh tip for every second step only
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
for n in range(5):
    if not p300.has_tip:
        p300.pick_up_tip()
    p300.aspirate(50, series[n])
    p300.dispense(50, series[n + 1])
    p300.mix(3, 80, series[n + 1])
    if n % 2:
        p300.drop_tip()
p300.drop_tip()

# SD-5, SD-1 fails: one tip, and one step of the series not mixed
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
p300.pick_up_tip()
for n, (left, right) in enumerate(zip(series, series[1:])):
    p300.aspirate(50, left)
    p300.dispense(50, right)
    if n != 3:
        p300.mix(3, 80, right)
p300.drop_tip()

# SD-5 warns: one tip, which mixes each well before it draws from it, and the last one at the end
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
p300.pick_up_tip()
p300.transfer(50, series[:-1], series[1:], mix_before=(3, 80), new_tip="never")
p300.mix(3, 80, series[-1])
p300.drop_tip()

# SD-1 fails: each well is mixed before the next draw, and nothing is drawn from the last one
p300.distribute(100, diluent, series[1:])
p300.transfer(150, stock, series[0])
p300.transfer(50, series[:-1], series[1:], mix_before=(3, 80), new_tip="always")

# SD-1, SD-5 passes: two series in a row, each with a probe in all its wells and a control behind it
for start, probe in zip((0, 6), tubes.rows()[1]):
    wells = plate.rows()[1][start : start + 6]
    p300.transfer(60, diluent, wells, new_tip="once")
    for well in wells:
        p300.transfer(20, probe, well)
    p300.transfer(80, stock, wells[0], mix_after=(3, 80))
    for left, right in zip(wells[:4], wells[1:5]):
        p300.transfer(80, left, right, mix_after=(3, 80))

# deck
diluent = reservoir["A12"]
stocks = deepwell.columns()[0]
columns = plate.rows()[0]

# SD-1, SD-2, SD-3, SD-5 passes: eight series side by side, with eight channels
m300.transfer(100, diluent, columns[1:11], new_tip="once")
m300.transfer(200, stocks[0], columns[0])
for n in range(10):
    m300.transfer(100, columns[n], columns[n + 1], mix_after=(3, 80))

# SD-1 fails: eight series side by side, never mixed
m300.transfer(100, diluent, columns[1:11], new_tip="once")
m300.transfer(200, stocks[0], columns[0])
for n in range(10):
    m300.transfer(100, columns[n], columns[n + 1])

# SD-2 fails: eight channels skip a column
m300.transfer(100, diluent, columns[1:6], new_tip="once")
m300.transfer(200, stocks[0], columns[0])
for left, right in [(0, 1), (1, 2), (1, 3), (3, 4), (4, 5)]:
    m300.transfer(50, columns[left], columns[right], mix_after=(3, 80))

# SD-3 fails: a column that no diluent reaches
m300.transfer(100, diluent, [columns[1], columns[2], columns[4]], new_tip="once")
m300.transfer(200, stocks[0], columns[0])
for left, right in zip(columns[:4], columns[1:5]):
    m300.transfer(100, left, right, mix_after=(3, 80))

# SD-4 fails: a column filled from the stocks
m300.transfer(100, diluent, columns[1:4], new_tip="once")
m300.transfer(100, stocks[0], columns[4])
m300.transfer(200, stocks[0], columns[0])
for left, right in zip(columns[:4], columns[1:5]):
    m300.transfer(50, left, right, mix_after=(3, 80))

# SD-5 warns: eight tips through all columns, mixed
m300.transfer(100, diluent, columns[1:11], new_tip="once")
m300.transfer(200, stocks[0], columns[0])
m300.pick_up_tip()
for n in range(10):
    m300.transfer(100, columns[n], columns[n + 1], mix_after=(3, 80), new_tip="never")
m300.drop_tip()

# deck
pbs = protocol.define_liquid("PBS (diluent)", "", "#aaccff")
antibody = protocol.define_liquid("antibody stock", "1 mg/mL", "#ffcc00")
tubes["A1"].load_liquid(antibody, 300)
reservoir["A5"].load_liquid(pbs, 12000)
titration = plate.columns()[5]

# SD-3, SD-4, SD-5 passes: a titration of liquids that are loaded
p300.transfer(75, reservoir["A5"], titration[1:], new_tip="once")
p300.transfer(150, tubes["A1"], titration[0])
for upper, lower in zip(titration, titration[1:]):
    p300.transfer(75, upper, lower, mix_after=(4, 60), new_tip="always")

# SD-4 fails: the buffer is taken from the antibody's tube
p300.transfer(30, tubes["A1"], titration[1:], new_tip="always")
p300.transfer(60, tubes["A1"], titration[0])
for upper, lower in zip(titration, titration[1:]):
    p300.transfer(30, upper, lower, mix_after=(4, 25), new_tip="always")

# deck
lysis_buffer, dpbs, urea = reservoir["A1"], reservoir["A2"], reservoir["A3"]
standard = tubes["A1"]
curve = plate.rows()[0][:6]
samples = deepwell.columns()[0]

# SD-4 warns: several buffers are used, and nothing says that the standards' own is no diluent
p300.distribute(50, lysis_buffer, curve)
p300.transfer(50, standard, curve[0], mix_after=(3, 40))
for left, right in zip(curve, curve[1:]):
    p300.transfer(50, left, right, mix_after=(3, 40), new_tip="always")
p300.distribute(100, dpbs, [well.top() for column in deepwell.columns()[:4] for well in column])
