"""Where work is done that can be done anywhere: other processes of this machine, or a cluster."""
