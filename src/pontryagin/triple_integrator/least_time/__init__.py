"""The least time under a bound on |u|, the problem that section 3 calls mutual to the least peak."""
