"""What the stack computed against what was true."""
