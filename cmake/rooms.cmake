# A room is a folder with a library of the project. Its public headers are in include/, mostly as <evalcts/NAME/...>, and
# its private headers are next to its sources. docs/architecture.md says which room may use which; the test `rooms` compares
# it with the rooms that are declared here and with the includes of the sources.
#   evalcts_room(NAME [HOT] SOURCES file... USES room... LINK public-library... PRIVATE_LINK library...)
# makes the library evalcts_NAME. It is compiled with evalcts_light_options unless it is HOT: most time of a run is spent in
# the library under test, in the oracle and in the evaluator. A HOT room cannot reuse the precompiled header of another one.
function(evalcts_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "HOT" "" "SOURCES;USES;LINK;PRIVATE_LINK")
  add_library(evalcts_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(evalcts_${name} PUBLIC include PRIVATE .)
  foreach(used ${ROOM_USES})
    # The targets of the oracle and the evaluator have other names; LINK or PRIVATE_LINK names them.
    if(NOT used MATCHES "^(reference|production)$")
      target_link_libraries(evalcts_${name} PUBLIC evalcts_${used})
    endif()
  endforeach()
  target_link_libraries(evalcts_${name} PUBLIC ${ROOM_LINK} PRIVATE ${ROOM_PRIVATE_LINK}
                        $<IF:$<BOOL:${ROOM_HOT}>,evalcts_options,evalcts_light_options>)
  evalcts_declare_room(${name} ${ROOM_USES})
endfunction()

# Declares a room whose targets are made without evalcts_room. The other arguments are the rooms that it uses.
function(evalcts_declare_room name)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE ";" " " uses "${ARGN}")
  set_property(GLOBAL APPEND_STRING PROPERTY EVALCTS_ROOMS "${folder}: ${uses}\n")
endfunction()

# Writes a line "FOLDER: ROOM..." for each declared room into the file, for the test `rooms`.
function(evalcts_write_rooms file)
  get_property(rooms GLOBAL PROPERTY EVALCTS_ROOMS)
  file(WRITE ${file} "${rooms}")
endfunction()
