"""Long studies: seeded, bounded in time, resumable; their tables are committed with keys of their sources.

    python -m studies soak --seconds 7200

A study has parts, a part has chunks. Each finished chunk is a file of its own under ``build/studies``, so
that a run that is killed loses the chunk at work and no more, and a later run goes on from there.
"""
