"""The scripted fault drill: real processes, a real store, Opentrons' own engine as the robot."""
