from hypothesis import settings

settings.register_profile("compiling", deadline=None)  # a first call may compile
settings.load_profile("compiling")
