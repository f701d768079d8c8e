// The headers precompiled in tests/CMakeLists.txt belong to a target, and a target needs a file.
