"""The rendezvous as posed, in the user's units and in the solver's, and the report's cases."""
