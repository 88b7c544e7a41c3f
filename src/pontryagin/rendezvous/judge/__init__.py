"""The rendezvous solved by a direct method, as an independent check."""
