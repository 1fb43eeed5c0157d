"""Many runs, their figures side by side."""
