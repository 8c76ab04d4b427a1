# Compiler settings of foam itself: warnings, reproducible floating point, sanitizers.

add_library(foam_compiler INTERFACE)
target_compile_options(foam_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -ffp-contract=off)   # the same bits with and without fused multiply-add
if(FOAM_SANITIZE)
  add_compile_options(-fsanitize=${FOAM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${FOAM_SANITIZE})
endif()
target_link_options(foam_compiler INTERFACE -Wl,--allow-shlib-undefined -Wl,-z,lazy)
