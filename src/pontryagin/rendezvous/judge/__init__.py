"""The cases of the report solved by a direct method, as an independent check."""
