"""The default translator's architecture on commands that people wrote: `python -m models.language.human --data FOLDER`.

`data` reads the published files, `environment` knows the things that they are about, `lifting` makes templates and
arguments of their formulas, `system` trains and reads the networks, `baseline` is what they are compared with.
`families`, `waypoints` and `lang2ltl` do the same for formulas that have lengths.
"""
