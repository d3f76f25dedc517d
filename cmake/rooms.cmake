# A room of the project: a library with the public headers in include/ (as <evalcts/NAME/...> or the like) and private
# ones beside its sources. docs/architecture.md says which room may use which; the test `rooms` compares that with the
# rooms declared here and with what the sources include.
#   evalcts_room(NAME [LIGHT] SOURCES file... USES room... LINK public-library... PRIVATE_LINK library...)
# makes evalcts_NAME; with LIGHT by evalcts_light_options, which needs a precompiled header of its own.
function(evalcts_room name)
  cmake_parse_arguments(PARSE_ARGV 1 ROOM "LIGHT" "" "SOURCES;USES;LINK;PRIVATE_LINK")
  add_library(evalcts_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(evalcts_${name} PUBLIC include PRIVATE .)
  foreach(used ${ROOM_USES})
    # The oracle and the evaluator have targets of their own.
    if(NOT used MATCHES "^(reference|production)$")
      target_link_libraries(evalcts_${name} PUBLIC evalcts_${used})
    endif()
  endforeach()
  target_link_libraries(evalcts_${name} PUBLIC ${ROOM_LINK} PRIVATE ${ROOM_PRIVATE_LINK}
                        $<IF:$<BOOL:${ROOM_LIGHT}>,evalcts_light_options,evalcts_options>)
  evalcts_declare_room(${name} ${ROOM_USES})
endfunction()

# For rooms whose targets are made otherwise.
function(evalcts_declare_room name)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE ";" " " uses "${ARGN}")
  set_property(GLOBAL APPEND_STRING PROPERTY EVALCTS_ROOMS "${folder}: ${uses}\n")
endfunction()

# Writes "FOLDER: ROOM..." for each room, for the test.
function(evalcts_write_rooms file)
  get_property(rooms GLOBAL PROPERTY EVALCTS_ROOMS)
  file(WRITE ${file} "${rooms}")
endfunction()
