"""What compiles and what is compiled: exact primitives, elementary functions, random streams, generated modules."""
