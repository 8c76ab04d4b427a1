# Compiler settings of foam itself: warnings, reproducible floating point, sanitizers.

add_library(foam_compiler INTERFACE)
# -Wno-restrict: g++ 12 sees overlap in std::string operator+ (GCC bug 105651).
target_compile_options(foam_compiler INTERFACE
  -Wall -Wextra -Wpedantic $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow> -Wconversion -Wno-restrict -Wno-sign-conversion
  -ffp-contract=off                        # the same bits with and without fused multiply-add
  -fno-math-errno -fno-trapping-math)      # the same bits, faster: nothing reads errno or traps after a computation
if(FOAM_SANITIZE)
  add_compile_options(-fsanitize=${FOAM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${FOAM_SANITIZE})
endif()
