"""Elementary functions, random streams, and generated modules that are compiled or plain Python."""
