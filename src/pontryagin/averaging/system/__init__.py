"""Phase systems: equations of motion, control sets, and the averaged Hamiltonian h0 computed from them."""
