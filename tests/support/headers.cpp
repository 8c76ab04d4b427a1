// Compiled once for all tests: see tests/CMakeLists.txt, which names the headers.
