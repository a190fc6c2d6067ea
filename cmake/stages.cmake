# One static library per stage, in the order of the data; a stage may use the stages before it only.
# Sources are src/<stage>/**.cpp, tests are test/<stage>/**_test.cpp. command_line is no stage of the data, but built like one: what the
# programs have in common, with ROS or without.

set(IMD_STAGES units interpolation trajectory encoding protocol axis motion recording transport commissioning emulation
               hardware command_line)
set(IMD_USES_units "")
set(IMD_USES_interpolation "")
set(IMD_USES_trajectory "")
set(IMD_USES_encoding trajectory interpolation)
set(IMD_USES_protocol units)
set(IMD_USES_axis encoding protocol)
set(IMD_USES_motion axis trajectory)
set(IMD_USES_recording motion protocol)
set(IMD_USES_transport protocol)
set(IMD_USES_commissioning protocol transport units)
set(IMD_USES_emulation interpolation protocol transport)
set(IMD_USES_hardware motion recording transport emulation units)
set(IMD_USES_command_line units)

# Sets IMD_SOURCES_<stage>, and IMD_LIBRARIES to the stages that have a library to link: users before the used, as static
# libraries want it. A stage of headers only has none.
macro(imd_find_stages)
  set(IMD_LIBRARIES "")
  foreach(stage IN LISTS IMD_STAGES)
    file(GLOB_RECURSE IMD_SOURCES_${stage} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${stage}/*.cpp)
    if(IMD_SOURCES_${stage})
      list(INSERT IMD_LIBRARIES 0 imd_${stage})
    endif()
  endforeach()
endmacro()

function(imd_add_stages)
  add_library(imd_settings INTERFACE)
  target_include_directories(imd_settings INTERFACE ${PROJECT_SOURCE_DIR}/include)
  target_compile_options(imd_settings INTERFACE -Wall -Wextra -Wconversion -Wshadow
                         $<$<BOOL:${IMD_WARNINGS_AS_ERRORS}>:-Werror>)

  foreach(stage IN LISTS IMD_STAGES)
    if(IMD_SOURCES_${stage})
      add_library(imd_${stage} STATIC ${IMD_SOURCES_${stage}})
      set(scope PUBLIC)
    else()
      add_library(imd_${stage} INTERFACE)
      set(scope INTERFACE)
    endif()
    target_link_libraries(imd_${stage} ${scope} imd_settings fmt::fmt)
    foreach(used IN LISTS IMD_USES_${stage})
      target_link_libraries(imd_${stage} ${scope} imd_${used})
    endforeach()
  endforeach()
  target_link_libraries(imd_recording ${scope} yaml-cpp)
  target_include_directories(imd_hardware SYSTEM ${scope} ${urdfdom_INCLUDE_DIRS})
  target_link_libraries(imd_hardware ${scope} yaml-cpp ${urdfdom_LIBRARIES})
  target_include_directories(imd_command_line SYSTEM ${scope} ${Boost_INCLUDE_DIRS})
  target_link_libraries(imd_command_line ${scope} yaml-cpp Boost::program_options)
endfunction()

# A GoogleTest program NAME from sources, run by ctest and by catkin's run_tests alike, result in test_results as JUnit XML.
# Further arguments are libraries. Built by target `tests`, not by `all`.
function(imd_add_gtest name sources)
  add_executable(${name} EXCLUDE_FROM_ALL ${sources})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_compile_definitions(${name} PRIVATE IMD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # Half of all compiling is that of tests, and they are quick enough without: 10.7 s become 6.2 s for a file of test/hardware.
  target_compile_options(${name} PRIVATE -O1 -g1)
  target_link_libraries(${name} PRIVATE imd_settings ${ARGN} GTest::GTest GTest::Main yaml-cpp)
  add_dependencies(tests ${name})
  set(xml gtest-${name}.xml)
  catkin_run_tests_target("gtest" ${name} ${xml} DEPENDENCIES ${name}
    COMMAND "${PROJECT_BINARY_DIR}/${name} --gtest_output=xml:${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${xml}")
endfunction()

# catkin asks for tests unless it is told not to, and who wants to use the package need not have what they need: all of them or none.
# scripts/test fails where there are none: it builds the target `tests`.
macro(imd_find_test_packages)
  find_package(GTest QUIET)
  find_package(rostest QUIET)
  if(GTest_FOUND AND rostest_FOUND)
    set(IMD_TEST_PACKAGES_FOUND TRUE)
  else()
    set(IMD_TEST_PACKAGES_FOUND FALSE)
    message(STATUS "no tests: GTest or rostest is not installed; on Debian: scripts/setup test")
  endif()
endmacro()

function(imd_add_stage_tests)
  foreach(stage IN LISTS IMD_STAGES)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/${stage}/*.cpp)
    if(stage STREQUAL recording)
      list(APPEND sources ${PROJECT_SOURCE_DIR}/test/protocol/allocation_count.cpp)
    endif()
    if(stage STREQUAL emulation)
      list(APPEND sources ${PROJECT_SOURCE_DIR}/test/interpolation/cip_interpolator.cpp)
    endif()
    if(sources)
      imd_add_gtest(${stage}_tests "${sources}" imd_${stage})
    endif()
  endforeach()
  target_link_libraries(commissioning_tests PRIVATE imd_emulation) # against emulated drives
  imd_let_calls_fail(transport_tests)
endfunction()

# Target `benchmarks`: every bench/*_bench.cpp in one program, built on request only. They play the scenarios of the
# whole-driver tests.
function(imd_add_benchmarks)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/*_bench.cpp)
  find_package(benchmark QUIET)
  find_package(GTest QUIET)
  if(sources AND benchmark_FOUND AND GTest_FOUND)
    add_executable(benchmarks EXCLUDE_FROM_ALL ${sources} ${PROJECT_SOURCE_DIR}/test/hardware/scenario.cpp)
    set_target_properties(benchmarks PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
    target_include_directories(benchmarks PRIVATE ${PROJECT_SOURCE_DIR}/test)
    target_compile_definitions(benchmarks PRIVATE IMD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    target_link_libraries(benchmarks PRIVATE imd_hardware benchmark::benchmark benchmark::benchmark_main GTest::GTest yaml-cpp)
  endif()
endfunction()
