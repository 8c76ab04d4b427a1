# Compiler settings of foam itself: warnings, reproducible floating point, sanitizers. What a compiler or linker does not know
# is left out.
include(CheckCXXCompilerFlag)
include(CheckLinkerFlag)

# foam_flags(LIST flag...): the flags if the compiler knows them all.
function(foam_flags LIST)
  string(MAKE_C_IDENTIFIER "FOAM_HAS${ARGN}" KNOWN)
  string(JOIN " " FLAGS ${ARGN})
  check_cxx_compiler_flag("${FLAGS}" ${KNOWN})
  if(${KNOWN})
    set(${LIST} ${${LIST}} ${ARGN} PARENT_SCOPE)
  endif()
endfunction()

set(FOAM_COMPILE_OPTIONS)
foam_flags(FOAM_COMPILE_OPTIONS -Wall -Wextra -Wpedantic)
foam_flags(FOAM_SHADOW -Wshadow)
list(APPEND FOAM_COMPILE_OPTIONS $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:${FOAM_SHADOW}>)
foam_flags(FOAM_COMPILE_OPTIONS -Wconversion)
foam_flags(FOAM_COMPILE_OPTIONS -Wno-restrict) # g++ 12 sees overlap in std::string operator+ (GCC bug 105651)
foam_flags(FOAM_COMPILE_OPTIONS -Wno-sign-conversion)
foam_flags(FOAM_COMPILE_OPTIONS -ffp-contract=off) # the same bits with and without fused multiply-add
foam_flags(FOAM_COMPILE_OPTIONS -fno-math-errno -fno-trapping-math) # the same bits, faster: nothing reads errno or traps after a computation
# fmt 9 asks for "Og" where nothing is optimised. g++ 12 takes that out of a precompiled header, and Eigen does not compile then.
list(APPEND FOAM_COMPILE_OPTIONS "$<$<CONFIG:Debug>:-DFMT_GCC_PRAGMA(text)=>")
add_library(foam_compiler INTERFACE)
target_compile_options(foam_compiler INTERFACE ${FOAM_COMPILE_OPTIONS})
if(FOAM_SANITIZE)
  add_compile_options(-fsanitize=${FOAM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${FOAM_SANITIZE})
endif()

# A build id is part of the keys of the cache. FoamPlugin.cmake asks, too.
check_linker_flag(CXX -Wl,--build-id=sha1 FOAM_HAS_BUILD_ID)
check_linker_flag(CXX -Wl,--no-undefined FOAM_HAS_NO_UNDEFINED)
set(FOAM_LINK_OPTIONS)
if(FOAM_HAS_BUILD_ID)
  list(APPEND FOAM_LINK_OPTIONS -Wl,--build-id=sha1)
endif()
if(FOAM_HAS_NO_UNDEFINED AND NOT FOAM_SANITIZE) # what a sanitizer calls is in the program
  list(APPEND FOAM_LINK_OPTIONS -Wl,--no-undefined)
endif()
