"""The rendezvous solved in Sapunkov's orbital elements."""
