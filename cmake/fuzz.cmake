# test/fuzz/NAME.cpp: a fuzzer each, a function LLVMFuzzerTestOneInput; beside them are what they share (support/) and their seeds
# (seeds/NAME/). With IMD_SANITIZE=address each becomes a program of libFuzzer; otherwise all are in one GoogleTest program
# that gives each its seeds.

# Of what is beside the stages only what fuzzers need: what reads files, and the simulation's watch over the limits. So a build takes
# minutes, and no messages are generated.
set(IMD_FUZZED_FILES node/robot_description.cpp tools/goal_file.cpp
                     simulation/arm.cpp simulation/ledger.cpp simulation/known_faults.cpp simulation/invariants/limits.cpp)
list(TRANSFORM IMD_FUZZED_FILES PREPEND ${PROJECT_SOURCE_DIR}/src/)

function(imd_add_fuzz_support)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/fuzz/support/*.cpp)
  add_library(imd_fuzz STATIC EXCLUDE_FROM_ALL ${sources} ${IMD_FUZZED_FILES})
  target_include_directories(imd_fuzz PUBLIC ${PROJECT_SOURCE_DIR}/test ${PROJECT_SOURCE_DIR}/src)
  target_include_directories(imd_fuzz SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
  target_link_libraries(imd_fuzz PUBLIC imd_hardware imd_command_line ${roslib_LIBRARIES} ${roscpp_LIBRARIES})
endfunction()

function(imd_add_fuzzers)
  add_custom_target(fuzzers)
  file(GLOB fuzzers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/fuzz/*.cpp)
  foreach(file IN LISTS fuzzers)
    get_filename_component(name ${file} NAME_WE)
    add_executable(fuzz_${name} EXCLUDE_FROM_ALL ${file})
    set_target_properties(fuzz_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/fuzzers OUTPUT_NAME ${name})
    target_link_libraries(fuzz_${name} PRIVATE imd_fuzz)
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    add_dependencies(fuzzers fuzz_${name})
  endforeach()
endfunction()

# The names of the functions differ only here, so that one program can have them all.
function(imd_add_fuzz_tests)
  file(GLOB fuzzers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/fuzz/*.cpp)
  set(IMD_FUZZERS "")
  foreach(file IN LISTS fuzzers)
    get_filename_component(name ${file} NAME_WE)
    set_property(SOURCE ${file} APPEND PROPERTY COMPILE_DEFINITIONS LLVMFuzzerTestOneInput=fuzz_${name})
    string(APPEND IMD_FUZZERS "IMD_FUZZER(${name})\n")
  endforeach()
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/fuzz_seeds/fuzzers.inc CONTENT "${IMD_FUZZERS}")
  file(GLOB tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/fuzz/tests/*.cpp)
  imd_add_gtest(fuzz_tests "${fuzzers};${tests}" imd_fuzz)
  target_include_directories(fuzz_tests PRIVATE ${PROJECT_BINARY_DIR}/fuzz_seeds)
endfunction()
