"""All that knows Opentrons' Python.

``instrumentation`` hears what a protocol does, in a rehearsal and on a robot; ``rehearsal`` runs
it in Opentrons' simulator; ``run_state`` sees its pauses and its stop; ``run_refusal`` and
``protocol_frames`` end it.
"""
