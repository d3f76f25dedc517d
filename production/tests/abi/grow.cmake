# Writes to OUTPUT the header of a later version: HEADER with one more member in each structure that begins with `size`.
file(READ ${HEADER} text)
string(REGEX MATCHALL "  size_t size;[^}]*} glev_[a-z_]+;" structures "${text}")
list(LENGTH structures count)
if(count LESS 9)
  message(FATAL_ERROR "${HEADER} has ${count} structures that begin with `size`: expected nine or more")
endif()
string(REGEX REPLACE "(  size_t size;[^}]*)(} glev_[a-z_]+;)" "\\1  size_t of_a_later_version[3];\n\\2" text "${text}")
file(WRITE ${OUTPUT} "${text}")
