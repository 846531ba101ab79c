"""What a spec that can be used probably does not mean to say, each kind of it in a module of its own."""
