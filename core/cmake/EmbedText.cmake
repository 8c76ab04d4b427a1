# cmake -DFOLDER=... -DOUTPUT=... -P EmbedText.cmake: the files of a folder as text within a C++ source. page.css becomes
# foam::report::page_css, as report/resource.hpp declares it.
file(GLOB FILES "${FOLDER}/*")
set(SOURCE "// Made by EmbedText.cmake.\n#include \"report/resource.hpp\"\n\nnamespace foam::report {\n")
foreach(FILE IN LISTS FILES)
  cmake_path(GET FILE FILENAME NAME)
  string(MAKE_C_IDENTIFIER "${NAME}" NAME)
  file(READ "${FILE}" TEXT)
  file(SHA256 "${FILE}" DIGEST)
  string(APPEND SOURCE "\nconst Resource ${NAME}{R\"resource(${TEXT})resource\", \"${DIGEST}\"};\n")
endforeach()
file(WRITE "${OUTPUT}" "${SOURCE}\n} // namespace foam::report\n")
