"""The rendezvous solved by the repaired equations of reduced dimension."""
