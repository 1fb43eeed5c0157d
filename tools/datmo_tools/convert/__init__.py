"""Recordings of other sources become bags of the stack."""
