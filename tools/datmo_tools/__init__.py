"""Python side of the tools: converters to bags of the stack's data contract."""
