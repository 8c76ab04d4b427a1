# Writes the commit that is built into a header, if it changed: cmake -DSOURCE=… -DBUILD=… -DHEADER=… -P commit.cmake. It is empty
# where the source is no clone.
execute_process(COMMAND git -C "${SOURCE}" rev-parse --show-toplevel OUTPUT_VARIABLE CLONE OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(REAL_PATH "${SOURCE}" SOURCE)
set(COMMIT "")
if(CLONE STREQUAL SOURCE)
  execute_process(COMMAND git -C "${SOURCE}" describe --always --exclude=* --dirty=+changes
    OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT "// Made by commit.cmake.
#define FOAM_COMMIT \"@COMMIT@\"
#define FOAM_BUILD \"@BUILD@\"
")
