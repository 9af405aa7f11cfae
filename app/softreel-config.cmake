# Visual regression tests with softreel, for any project that uses CMake (3.18 or newer):
#
#   enable_testing()
#   find_package(softreel REQUIRED)         # -Dsoftreel_DIR=this folder, or softreel installed
#   softreel_add_compare_test(NAME hello REFERENCE frames/hello ACTUAL ${CMAKE_BINARY_DIR}/out/hello)
#
# softreel_add_compare_test(
#   NAME name                      of the test
#   REFERENCE file_or_folder       relative to the current source folder; so are SCENE and RULES
#   ACTUAL file_or_folder          what another program (or an earlier test: DEPENDS) has rendered
#   | SCENE scene.toml             or a scene that softreel renders afresh
#   [TOLERANCE driver]             as --tolerance
#   [RULES rules.toml]             as --rules
#   [FRAMES 1,10]                  of a scene whose reference does not exist yet
#   [SET key=value ...]            of the scene
#   [DEPENDS test ...]             tests that have to run before
#   [LABELS label ...])
#
# A test that fails leaves NAME.html (open it), NAME.json and NAME.xml (JUnit) in compare/ of the current binary folder.
# Each test has a target NAME_update that accepts the actual pictures:  cmake --build . --target hello_update
if(NOT SOFTREEL_PROGRAM)
  if(TARGET softreel)
    set(SOFTREEL_PROGRAM $<TARGET_FILE:softreel>)
  else()
    find_program(SOFTREEL_PROGRAM softreel HINTS ${CMAKE_CURRENT_LIST_DIR}/../../../bin
                 ${CMAKE_CURRENT_LIST_DIR}/../build/release)
    if(NOT SOFTREEL_PROGRAM)
      set(softreel_FOUND FALSE)
      set(softreel_NOT_FOUND_MESSAGE "the program softreel is not there; say -DSOFTREEL_PROGRAM=/path/to/softreel")
      return()
    endif()
  endif()
endif()

function(softreel_add_compare_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;REFERENCE;ACTUAL;SCENE;TOLERANCE;RULES;FRAMES" "SET;DEPENDS;LABELS")
  if(NOT arg_NAME OR NOT arg_REFERENCE OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "softreel_add_compare_test: needs NAME and REFERENCE; not understood: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if((arg_ACTUAL AND arg_SCENE) OR (NOT arg_ACTUAL AND NOT arg_SCENE))
    message(FATAL_ERROR "softreel_add_compare_test(${arg_NAME}): needs either ACTUAL or SCENE")
  endif()
  get_filename_component(reference ${arg_REFERENCE} ABSOLUTE)
  get_filename_component(actual ${arg_ACTUAL}${arg_SCENE} ABSOLUTE)
  string(MAKE_C_IDENTIFIER ${arg_NAME} file)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/compare)
  file(MAKE_DIRECTORY ${out})
  set(command ${SOFTREEL_PROGRAM} compare ${reference} ${actual} --quiet)
  if(arg_TOLERANCE)
    list(APPEND command --tolerance ${arg_TOLERANCE})
  endif()
  if(arg_RULES)
    get_filename_component(rules ${arg_RULES} ABSOLUTE)
    list(APPEND command --rules ${rules})
  endif()
  if(arg_FRAMES)
    list(APPEND command --frames ${arg_FRAMES})
  endif()
  foreach(key_value ${arg_SET})
    list(APPEND command --set ${key_value})
  endforeach()
  add_test(NAME ${arg_NAME}
           COMMAND ${command} --report ${out}/${file}.html --json ${out}/${file}.json --junit ${out}/${file}.xml)
  set_tests_properties(${arg_NAME} PROPERTIES DEPENDS "${arg_DEPENDS}" LABELS "${arg_LABELS}")
  add_custom_target(${file}_update COMMAND ${command} --update VERBATIM)
endfunction()
