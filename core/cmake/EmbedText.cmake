# cmake "-DFILES=A;B" -DOUTPUT=... -P EmbedText.cmake: files as text within a C++ source. page.css becomes
# foam::embedded::page_css, as data/embedded_text.hpp declares it.
set(SOURCE "// Made by EmbedText.cmake.\n#include \"data/embedded_text.hpp\"\n\nnamespace foam::embedded {\n")
foreach(FILE IN LISTS FILES)
  cmake_path(GET FILE FILENAME NAME)
  string(MAKE_C_IDENTIFIER "${NAME}" NAME)
  file(READ "${FILE}" TEXT)
  file(SHA256 "${FILE}" DIGEST)
  string(APPEND SOURCE "\nconst Text ${NAME}{R\"text(${TEXT})text\", \"${DIGEST}\"};\n")
endforeach()
file(WRITE "${OUTPUT}" "${SOURCE}\n} // namespace foam::embedded\n")
