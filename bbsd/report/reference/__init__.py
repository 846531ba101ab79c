"""What is generated from the code: the references of the language and of Python, and the JSON Schema of specs."""
