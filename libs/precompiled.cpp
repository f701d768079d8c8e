// The headers precompiled in libs/CMakeLists.txt belong to a target, and a target needs a file.
