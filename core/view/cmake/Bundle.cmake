# cmake "-DSCRIPTS=a.js;b.js" -DOUTPUT=view.js -P Bundle.cmake: small scripts one after the other as one module, for pages that are
# one file. Names at their top level are known to those that follow.
set(BUNDLE "")
foreach(SCRIPT IN LISTS SCRIPTS)
  file(READ "${SCRIPT}" TEXT)
  string(APPEND BUNDLE "${TEXT}\n")
endforeach()
file(WRITE "${OUTPUT}" "${BUNDLE}")
