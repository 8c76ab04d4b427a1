# foam_abi_record(RECORD HEADER): writes HEADER, which defines FOAM_ABI_LAYOUT: a digest of what the text RECORD of core/abi says
# of the public types. It is part of every plugin's fingerprint, so a plugin built against other headers is refused, of an open
# epoch too.
function(foam_abi_record RECORD HEADER)
  string(FIND "${RECORD}" "\n\n" HEAD_END) # the head says whether the epoch is open
  string(SUBSTRING "${RECORD}" ${HEAD_END} -1 LAYOUT)
  string(SHA256 DIGEST "${LAYOUT}")
  string(SUBSTRING "${DIGEST}" 0 16 DIGEST)
  file(CONFIGURE OUTPUT "${HEADER}" CONTENT [[
// Made by FoamAbi.cmake from the record of the public types; see docs/dev/abi.md.
#pragma once

#define FOAM_ABI_LAYOUT "@DIGEST@"
]] @ONLY)
endfunction()

# foam_read_abi_record(RESULT): the record of the epoch that abi.hpp names; a change of either configures anew.
function(foam_read_abi_record RESULT)
  set(HEADER "${PROJECT_SOURCE_DIR}/core/sdk/include/foam/sdk/abi.hpp")
  file(STRINGS "${HEADER}" EPOCH REGEX "^#define FOAM_ABI_EPOCH [0-9]+$")
  string(REGEX REPLACE "[^0-9]" "" EPOCH "${EPOCH}")
  set(RECORD "${PROJECT_SOURCE_DIR}/core/abi/epoch_${EPOCH}.txt")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${HEADER}" "${RECORD}")
  set(TEXT "\n\nnot recorded yet\n")
  if(EXISTS "${RECORD}")
    file(READ "${RECORD}" TEXT)
  else()
    message(WARNING "there is no ${RECORD}; remedy: FOAM_TEST_UPDATE=1 ctest -R abi_layout_check, then configure again")
  endif()
  set(${RESULT} "${TEXT}" PARENT_SCOPE)
endfunction()
