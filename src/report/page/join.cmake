# SPDX-License-Identifier: GPL-2.0-or-later
# cmake -DPAGE=page.html -DNAME=kPage "-DSTYLES=a.css;..." "-DSCRIPTS=a.js;..." -DOUT=page.cpp -P join.cmake
# Joins a page's files into one text and writes it as a C++ source. The scripts are modules that import only one another
# and have no two top-level names in common, so that they become one script without their imports and exports.
foreach(kind STYLES SCRIPTS)
  set(joined_${kind} "")
  foreach(file IN LISTS ${kind})
    file(READ "${file}" text)
    string(APPEND joined_${kind} "${text}")
  endforeach()
endforeach()
string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" joined_SCRIPTS "${joined_SCRIPTS}")
string(REGEX REPLACE "(^|\n)export " "\\1" joined_SCRIPTS "${joined_SCRIPTS}")
file(READ "${PAGE}" page)
string(REPLACE "@@STYLE@@" "${joined_STYLES}" page "${page}")
string(REPLACE "@@SCRIPT@@" "${joined_SCRIPTS}" page "${page}")
file(WRITE "${OUT}" "#include \"report/page_sources.hpp\"
const std::string_view qmorph::report::${NAME} = R\"~~~(${page})~~~\";
")
