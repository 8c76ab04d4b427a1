# cmake "-DFILES=A;B" -DHEADER=... -DNAMESPACE=... -DOUTPUT=... -P EmbedText.cmake: files as text within a C++ source. page.css
# becomes the EmbeddedText NAMESPACE::page_css, which HEADER declares.
set(SOURCE "// Made by EmbedText.cmake.\n#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n")
foreach(FILE IN LISTS FILES)
  cmake_path(GET FILE FILENAME NAME)
  string(MAKE_C_IDENTIFIER "${NAME}" NAME)
  file(READ "${FILE}" TEXT)
  file(SHA256 "${FILE}" DIGEST)
  string(APPEND SOURCE "\nconst EmbeddedText ${NAME}{R\"text(${TEXT})text\", \"${DIGEST}\"};\n")
endforeach()
file(WRITE "${OUTPUT}" "${SOURCE}\n} // namespace ${NAMESPACE}\n")
