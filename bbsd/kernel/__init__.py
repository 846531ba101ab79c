"""The only package that knows Numba: elementary functions, random streams, loading and compiling of kernels."""
