// Contains the precompiled header of all test executables.
