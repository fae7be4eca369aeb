cmake_minimum_required(VERSION 3.25)
# Writes the commit that is being built into a header; touches it only when it changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
  OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT COMMIT)
  set(COMMIT unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
  "#pragma once\n\n#include <string_view>\n\nnamespace longreach {\ninline constexpr std::string_view kCommit = \"@COMMIT@\";\n}\n"
  @ONLY)
