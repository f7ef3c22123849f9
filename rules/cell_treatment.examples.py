"""What the rules of cell treatments accept and refuse; `aegis-ot rules test` runs each snippet.

A heading says which rules a snippet is for; `deck` stands before all that follow it. Each is the
body of `run`; culture, tubes, reservoir, strips, p20, m20, p300 and m300 are on the deck.
"""

# deck
drug = tubes["A1"]
vehicle = tubes["A2"]
treated_wells = culture.columns()[0][:4]
vehicle_wells = culture.columns()[1][:4]

# CELL-1, CELL-2, CELL-3 passes: vehicle into the controls, drug into the treated, fresh tips
p20.transfer(5, vehicle, vehicle_wells, new_tip="always")
p20.transfer(5, drug, treated_wells, new_tip="always")

# CELL-1, CELL-3 passes: one tip for all controls, then one for all treated wells
p20.transfer(5, vehicle, vehicle_wells, new_tip="once")
p20.transfer(5, drug, treated_wells, new_tip="once")

# CELL-1, CELL-2 passes: an untreated control gets nothing at all
untreated = culture.columns()[2][:4]
for treated, control in zip(treated_wells, vehicle_wells):
    p20.transfer(5, drug, treated)
    p20.transfer(5, vehicle, control)

# CELL-1 fails: drug goes into a control well
p20.transfer(5, vehicle, vehicle_wells, new_tip="always")
p20.transfer(5, drug, treated_wells + vehicle_wells[:1], new_tip="always")

# CELL-1 fails: the drug's loop runs one column too far
untreated = culture.columns()[2][:4]
p20.transfer(5, vehicle, vehicle_wells, new_tip="always")
for n in range(4):
    for column in (culture.columns()[0], culture.columns()[2]):
        p20.transfer(5, drug, column[n])

# CELL-1 fails: drug is distributed over treated and untreated wells
untreated = culture["H12"]
p20.transfer(5, vehicle, vehicle_wells, new_tip="always")
p20.distribute(4, drug, [*treated_wells, untreated], disposal_volume=0)

# CELL-2 passes: vehicle in two portions for each control
p20.transfer(5, drug, treated_wells, new_tip="always")
for well in vehicle_wells:
    p20.pick_up_tip()
    for _ in range(2):
        p20.aspirate(2.5, vehicle)
        p20.dispense(2.5, well.top(-2))
    p20.drop_tip()

# CELL-2 fails: one vehicle control is left out
p20.transfer(5, vehicle, vehicle_wells[:-1], new_tip="always")
p20.transfer(5, drug, treated_wells, new_tip="always")

# CELL-2 fails: the vehicle goes to the treated wells instead of the last control
p20.transfer(5, drug, treated_wells, new_tip="always")
for n, well in enumerate(vehicle_wells):
    p20.transfer(5, vehicle, well if n < 3 else treated_wells[n])

# CELL-2 fails: the controls get no vehicle but in the first row
for row in range(4):
    p20.transfer(5, drug, treated_wells[row])
    if row == 0:
        p20.transfer(5, vehicle, vehicle_wells[row])

# CELL-3 passes: one tip, from the vehicle to the drug
p20.pick_up_tip()
p20.transfer(5, vehicle, vehicle_wells, new_tip="never")
p20.transfer(5, drug, treated_wells, new_tip="never")
p20.drop_tip()

# CELL-3 fails: one tip for drug and then vehicle
p20.pick_up_tip()
p20.transfer(5, drug, treated_wells, new_tip="never")
p20.transfer(5, vehicle, vehicle_wells, new_tip="never")
p20.drop_tip()

# CELL-3 fails: the tip that mixed a treated well mixes a control
p20.transfer(5, vehicle, vehicle_wells, new_tip="always")
p20.transfer(5, drug, treated_wells, new_tip="always")
p300.pick_up_tip()
for well in (treated_wells[0], vehicle_wells[0]):
    p300.mix(2, 50, well)
p300.drop_tip()

# CELL-3 fails: the drug's tip goes back for vehicle
p20.transfer(5, vehicle, vehicle_wells, new_tip="once")
p20.pick_up_tip()
p20.transfer(5, drug, treated_wells[:3], new_tip="never")
p20.aspirate(5, vehicle)
p20.dispense(5, treated_wells[3])
p20.drop_tip()
p20.transfer(5, drug, treated_wells[3])

# CELL-4 passes: one drug at one dose, one tip
p20.transfer(5, vehicle, vehicle_wells, new_tip="always")
p20.pick_up_tip()
for well in treated_wells:
    p20.aspirate(5, drug)
    p20.dispense(5, well)
p20.drop_tip()

# deck
doses = {1: tubes["B1"], 10: tubes["B2"], 100: tubes["B3"]}  # drug, uM
dosed_wells = {1: culture.rows()[0][:3], 10: culture.rows()[1][:3], 100: culture.rows()[2][:3]}
dmso = tubes["D6"]
dmso_wells = culture.rows()[7][:3]

# CELL-4, CELL-3 passes: one tip from the low to the high dose
p20.transfer(2, dmso, dmso_wells, new_tip="once")
p20.pick_up_tip()
for dose, drug in doses.items():
    p20.transfer(2, drug, dosed_wells[dose], new_tip="never")
p20.drop_tip()

# CELL-4 passes: from the high dose down, with a fresh tip for each
p20.transfer(2, dmso, dmso_wells, new_tip="once")
for dose in sorted(doses, reverse=True):
    drug = doses[dose]
    p20.transfer(2, drug, dosed_wells[dose], new_tip="once")

# CELL-4 warns: one tip from the high to the low dose, near the liquid
p20.transfer(2, dmso, dmso_wells, new_tip="once")
p20.pick_up_tip()
for dose in sorted(doses, reverse=True):
    drug = doses[dose]
    p20.transfer(2, drug, dosed_wells[dose], new_tip="never")
p20.drop_tip()

# CELL-4 fails: the low dose is mixed with the tip of the high one
p20.transfer(2, dmso, dmso_wells, new_tip="once")
for dose, drug in doses.items():
    p20.transfer(2, drug, dosed_wells[dose], new_tip="once")
p300.pick_up_tip()
for well in (dosed_wells[100][0], dosed_wells[1][0]):
    p300.mix(2, 50, well)
p300.drop_tip()

# deck
media = protocol.define_liquid("RPMI medium", "", "#ffaaaa")
reservoir["A1"].load_liquid(media, 14000)
solvent = protocol.define_liquid("DMSO vehicle", "", "#cccccc")
tubes["A1"].load_liquid(solvent, 500)
stauro = protocol.define_liquid("staurosporine (drug)", "", "#aa00aa")
tubes["A2"].load_liquid(stauro, 500)
taxol = protocol.define_liquid("paclitaxel (drug)", "", "#00aaaa")
tubes["A3"].load_liquid(taxol, 500)
stauro_treated = culture.columns()[3][:3]
taxol_treated = culture.columns()[4][:3]
vehicle_controls = culture.columns()[5][:3]

# CELL-1, CELL-2, CELL-4 passes: two compounds, a tip for each
p20.transfer(2, tubes["A1"], vehicle_controls, new_tip="once")
p20.transfer(2, tubes["A2"], stauro_treated, new_tip="once")
p20.transfer(2, tubes["A3"], taxol_treated, new_tip="once")

# CELL-3 passes: medium from above with one tip, behind the drug
p20.transfer(2, tubes["A1"], vehicle_controls, new_tip="always")
p20.transfer(2, tubes["A2"], stauro_treated, new_tip="always")
wells = [well.top() for well in vehicle_controls + stauro_treated]
p300.transfer(100, reservoir["A1"], wells, new_tip="once")

# CELL-1 fails: the vehicle controls get a compound
p20.transfer(2, tubes["A1"], vehicle_controls, new_tip="once")
p20.transfer(2, tubes["A2"], stauro_treated, new_tip="once")
for well in taxol_treated + vehicle_controls[2:]:
    p20.transfer(2, tubes["A3"], well)

# CELL-2 fails: the compound's tube stands in the vehicle's place
p20.transfer(2, tubes["A2"], stauro_treated, new_tip="once")
p20.transfer(2, tubes["A1"], vehicle_controls[:1], new_tip="once")

# CELL-4 warns: one tip for two compounds, near the liquid
p20.transfer(2, tubes["A1"], vehicle_controls, new_tip="once")
p20.pick_up_tip()
for well in stauro_treated:
    p20.aspirate(2, tubes["A2"])
    p20.dispense(2, well)
for well in taxol_treated:
    p20.aspirate(2, tubes["A3"])
    p20.dispense(2, well)
p20.drop_tip()

# CELL-4 fails: one tip mixes the wells of both compounds
p20.transfer(2, tubes["A1"], vehicle_controls, new_tip="once")
p20.transfer(2, tubes["A2"], stauro_treated, new_tip="always")
p20.transfer(2, tubes["A3"], taxol_treated, new_tip="always")
p300.pick_up_tip()
for well in stauro_treated + taxol_treated:
    p300.mix(2, 60, well)
p300.drop_tip()

# deck
compound = strips["A1"]
vehicle = strips["A12"]
medium = reservoir["A2"]
vehicle_control_column = culture["A12"]
treated_columns = culture.rows()[0][1:4]

# CELL-2, CELL-3, CELL-4 passes: columns of cells at a time, with eight channels
m20.transfer(3, vehicle, vehicle_control_column)
m20.transfer(3, compound, treated_columns, new_tip="once")

# CELL-1 fails: eight channels bring the compound to the column of controls
m20.transfer(3, vehicle, vehicle_control_column)
m20.transfer(3, compound, [*treated_columns, vehicle_control_column], new_tip="always")

# CELL-3 fails: eight tips that changed the medium of treated wells, then of the controls
m20.transfer(3, vehicle, vehicle_control_column)
m20.transfer(3, compound, treated_columns, new_tip="once")
m300.pick_up_tip()
for column in (*treated_columns, vehicle_control_column):
    m300.aspirate(50, medium)
    m300.dispense(50, column.bottom(1))
m300.drop_tip()
