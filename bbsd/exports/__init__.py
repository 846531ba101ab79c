"""Designs in other languages, written from one form of them, and verified through the real target."""
